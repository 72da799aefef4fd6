# Ray casting for the footage generator: Embree behind a C header. A library of its own, so that
# programs which only move pictures do not need Embree.
find_package(embree 3.13 REQUIRED CONFIG)

add_library(wo_raycast STATIC ${CMAKE_CURRENT_LIST_DIR}/raycast_embree.c)
target_include_directories(wo_raycast PUBLIC ${PROJECT_SOURCE_DIR}/ofx_host_stub)
target_link_libraries(wo_raycast PRIVATE wo_options embree PUBLIC wo_base)
