# The glue between OpenFX and the core, tested with a plugin of its own.
find_package(Threads REQUIRED)
set(probe_dir ${CMAKE_CURRENT_LIST_DIR}/plugins)
set(probe_bundles ${CMAKE_BINARY_DIR}/tests/plugins)
wo_add_ofx_plugin(Probe ${probe_dir}/probe_plugin.c ${probe_dir}/probe_effect.c
    ${probe_dir}/pointing_effect.c CORE wo_base DIRECTORY ${probe_bundles} NO_INSTALL)

# Under hosts as they are.
add_library(wo_glue_fixture STATIC
    ${CMAKE_CURRENT_LIST_DIR}/glue_fixture.c
    ${CMAKE_CURRENT_LIST_DIR}/mock_host.c
    ${CMAKE_CURRENT_LIST_DIR}/mock_objects.c
    ${CMAKE_CURRENT_LIST_DIR}/mock_overlay.c
    ${CMAKE_CURRENT_LIST_DIR}/mock_params.c
    ${CMAKE_CURRENT_LIST_DIR}/mock_props.c
    ${probe_dir}/probe_effect.c
    ${PROJECT_SOURCE_DIR}/plugins/ofx_pixels.c)
target_include_directories(wo_glue_fixture PUBLIC
    ${CMAKE_CURRENT_LIST_DIR} ${PROJECT_SOURCE_DIR}/plugins ${PROJECT_SOURCE_DIR}/include)
target_compile_definitions(wo_glue_fixture PRIVATE PROBE_BINARY="$<TARGET_FILE:Probe>")
target_link_libraries(wo_glue_fixture PUBLIC
    wo_base wo_options cmocka Threads::Threads ${CMAKE_DL_LIBS} m)
add_dependencies(wo_glue_fixture Probe)
foreach(name IN ITEMS glue_hosts glue_images glue_params glue_geometry)
    add_executable(test_${name} ${CMAKE_CURRENT_LIST_DIR}/test_${name}.c)
    target_link_libraries(test_${name} PRIVATE wo_glue_fixture)
    add_test(NAME contract.${name} COMMAND test_${name})
endforeach()

# Overlays, and an OpenGL that only writes down; its name is that of the real one.
add_library(wo_fake_gl SHARED ${CMAKE_CURRENT_LIST_DIR}/plugins/fake_gl.c)
target_link_libraries(wo_fake_gl PRIVATE wo_options)
set_target_properties(wo_fake_gl PROPERTIES OUTPUT_NAME GL SOVERSION 1 C_VISIBILITY_PRESET default
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests/fake_gl)
add_executable(test_glue_overlay ${CMAKE_CURRENT_LIST_DIR}/test_glue_overlay.c)
target_compile_definitions(test_glue_overlay PRIVATE
    FAKE_GL="$<TARGET_FILE:wo_fake_gl>")
target_link_libraries(test_glue_overlay PRIVATE wo_glue_fixture)
add_dependencies(test_glue_overlay wo_fake_gl)
add_test(NAME contract.glue_overlay COMMAND test_glue_overlay)

add_executable(test_ofx_pixels ${PROJECT_SOURCE_DIR}/tests/unit/test_ofx_pixels.c)
target_link_libraries(test_ofx_pixels PRIVATE wo_glue_fixture)
add_test(NAME unit.ofx_pixels COMMAND test_ofx_pixels)

# Under the host that forgives nothing.
add_executable(test_glue
    ${CMAKE_CURRENT_LIST_DIR}/test_glue.c
    ${CMAKE_CURRENT_LIST_DIR}/strict_fixture.c
    ${probe_dir}/probe_effect.c)
target_include_directories(test_glue PRIVATE ${CMAKE_CURRENT_LIST_DIR})
target_compile_definitions(test_glue PRIVATE PROBE_DIRECTORY="${probe_bundles}")
target_link_libraries(test_glue PRIVATE wo_host wo_base wo_options cmocka Threads::Threads m)
add_dependencies(test_glue Probe)
add_test(NAME contract.glue COMMAND test_glue)
set_tests_properties(contract.glue PROPERTIES LABELS threads)
