# Unit tests of core/base and core/image.
foreach(name IN ITEMS status context param locale report rect camera)
    add_executable(test_${name} ${CMAKE_CURRENT_LIST_DIR}/test_${name}.c)
    target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(test_${name} PRIVATE wo_base wo_options cmocka m)
    add_test(NAME unit.${name} COMMAND test_${name})
endforeach()
