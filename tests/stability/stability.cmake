# LensBlur where it hurts: extreme pictures and parameters, no memory, stopped at any moment.
set(stability_dir ${CMAKE_CURRENT_LIST_DIR})
foreach(name IN ITEMS extremes absurd alloc lens_random)
    add_executable(test_${name} ${stability_dir}/test_${name}.c)
    target_link_libraries(test_${name} PRIVATE wo_test_scenes)
    add_test(NAME stability.${name} COMMAND test_${name})
    set_tests_properties(stability.${name} PROPERTIES TIMEOUT 300)
endforeach()
set_tests_properties(stability.alloc PROPERTIES TIMEOUT 600)
