# Properties of LensBlur as a whole: what must hold whatever the picture is.
find_package(Threads REQUIRED)
set(property_dir ${CMAKE_CURRENT_LIST_DIR})

# Scenes, random numbers and threads for the tests of the core.
add_library(wo_test_scenes STATIC ${property_dir}/scenes.c)
target_include_directories(wo_test_scenes PUBLIC
    ${property_dir} ${PROJECT_SOURCE_DIR}/core ${PROJECT_SOURCE_DIR})
target_link_libraries(wo_test_scenes PUBLIC
    wo_core wo_base wo_options cmocka Threads::Threads m)

foreach(name IN ITEMS filter_image focus_control invariance knobs layout leave_out lens_image
        lens_looks lens_lights offered quality edges smoothness spread threads)
    add_executable(test_${name} ${property_dir}/test_${name}.c)
    target_link_libraries(test_${name} PRIVATE wo_test_scenes)
    add_test(NAME property.${name} COMMAND test_${name})
    set_tests_properties(property.${name} PROPERTIES TIMEOUT 300)
endforeach()
set_tests_properties(property.threads PROPERTIES LABELS threads)
target_compile_definitions(test_offered PRIVATE
    WO_CHOICES="${PROJECT_SOURCE_DIR}/tests/golden/choices.txt")

# The same of every method, over the footage too.
add_executable(test_coverage ${property_dir}/test_coverage.c)
target_link_libraries(test_coverage PRIVATE wo_test_scenes wo_blur_footage)
add_test(NAME property.coverage COMMAND test_coverage)
set_tests_properties(property.coverage PROPERTIES TIMEOUT 600)
