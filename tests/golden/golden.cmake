# Footage through the effect, against the reference by brute force.
add_library(wo_blur_footage STATIC ${CMAKE_CURRENT_LIST_DIR}/blur_footage.c)
target_include_directories(wo_blur_footage PUBLIC
    ${CMAKE_CURRENT_LIST_DIR} ${PROJECT_SOURCE_DIR}/core ${PROJECT_SOURCE_DIR}/footage
    ${PROJECT_SOURCE_DIR}/ofx_host_stub)
target_link_libraries(wo_blur_footage PUBLIC
    wo_footage wo_core wo_bridge wo_base wo_options cmocka m)

add_executable(test_golden ${CMAKE_CURRENT_LIST_DIR}/test_golden.c)
target_include_directories(test_golden PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(test_golden PRIVATE wo_blur_footage)
add_test(NAME golden.footage COMMAND test_golden)
set_tests_properties(golden.footage PROPERTIES TIMEOUT 600)

add_executable(test_seeds ${CMAKE_CURRENT_LIST_DIR}/test_seeds.c)
target_include_directories(test_seeds PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(test_seeds PRIVATE wo_blur_footage)
add_test(NAME golden.seeds COMMAND test_seeds)
set_tests_properties(golden.seeds PROPERTIES TIMEOUT 600)
