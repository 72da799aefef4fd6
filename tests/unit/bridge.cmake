# Unit tests of the bridges to foreign libraries.
find_package(Threads REQUIRED)
foreach(name IN ITEMS image_io image_formats image_faults image_mutants image_memory image_readers image_save colour picture)
    add_executable(test_${name} ${CMAKE_CURRENT_LIST_DIR}/test_${name}.c)
    target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(test_${name} PRIVATE wo_bridge wo_options cmocka Threads::Threads m)
    add_test(NAME unit.${name} COMMAND test_${name})
endforeach()
# Linked, not loaded late: so the allocations of this file of the bridge can fail, too.
target_link_libraries(test_image_memory PRIVATE wo_oiio)
target_link_options(test_image_memory PRIVATE
    -Wl,--wrap=malloc -Wl,--wrap=calloc -Wl,--wrap=realloc)
set_tests_properties(unit.image_memory PROPERTIES
    ENVIRONMENT "LSAN_OPTIONS=suppressions=${CMAKE_CURRENT_LIST_DIR}/../lsan.supp")
