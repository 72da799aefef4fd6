# Unit tests of the command line's own parts: arguments, frames, JSON.
set(cli ${PROJECT_SOURCE_DIR}/ofx_host_stub/cli)
add_executable(test_cli ${CMAKE_CURRENT_LIST_DIR}/test_cli.c
    ${cli}/args.c ${cli}/command.c ${cli}/frames.c ${cli}/json.c ${cli}/json_read.c)
target_compile_definitions(test_cli PRIVATE _POSIX_C_SOURCE=200809L)
target_include_directories(test_cli PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(test_cli PRIVATE wo_base wo_options cmocka m)
add_test(NAME unit.cli COMMAND test_cli)

add_executable(test_pencil_map_file ${CMAKE_CURRENT_LIST_DIR}/test_pencil_map_file.c
    ${cli}/pencil_map_file.c)
target_compile_definitions(test_pencil_map_file PRIVATE _POSIX_C_SOURCE=200809L)
target_include_directories(test_pencil_map_file PRIVATE
    ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/ofx_host_stub)
target_link_libraries(test_pencil_map_file PRIVATE wo_core wo_bridge wo_options cmocka m)
add_test(NAME unit.pencil_map_file COMMAND test_pencil_map_file)

# Drawings: axes, escaping, files as a whole.
add_executable(test_plot ${CMAKE_CURRENT_LIST_DIR}/test_plot.c
    ${cli}/plot.c ${cli}/svg.c ${cli}/text_file.c ${cli}/../bridge/new_file.c)
target_compile_definitions(test_plot PRIVATE _XOPEN_SOURCE=700)
target_include_directories(test_plot PRIVATE
    ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/ofx_host_stub)
target_link_libraries(test_plot PRIVATE wo_base wo_options cmocka m)
add_test(NAME unit.plot COMMAND test_plot)

# What follows from errors and times.
add_executable(test_bench ${CMAKE_CURRENT_LIST_DIR}/test_bench.c
    ${cli}/bench_judge.c ${cli}/bench_page.c ${cli}/bench_table.c
    ${cli}/json.c ${cli}/json_read.c ${cli}/plot.c ${cli}/svg.c)
target_compile_definitions(test_bench PRIVATE _POSIX_C_SOURCE=200809L)
target_include_directories(test_bench PRIVATE ${PROJECT_SOURCE_DIR})
target_link_libraries(test_bench PRIVATE wo_base wo_options cmocka m)
add_test(NAME unit.bench COMMAND test_bench)

# Clips of another size and pixel aspect.
add_executable(test_picture_fit ${CMAKE_CURRENT_LIST_DIR}/test_picture_fit.c ${cli}/picture_fit.c)
target_compile_definitions(test_picture_fit PRIVATE _POSIX_C_SOURCE=200809L)
target_include_directories(test_picture_fit PRIVATE
    ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/ofx_host_stub)
target_link_libraries(test_picture_fit PRIVATE wo_base wo_options cmocka m)
add_test(NAME unit.picture_fit COMMAND test_picture_fit)

# Where a file keeps its depth.
add_executable(test_depth_channel ${CMAKE_CURRENT_LIST_DIR}/test_depth_channel.c
    ${cli}/depth_channel.c)
target_compile_definitions(test_depth_channel PRIVATE _DEFAULT_SOURCE)
target_include_directories(test_depth_channel PRIVATE
    ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/ofx_host_stub)
target_link_libraries(test_depth_channel PRIVATE wo_bridge wo_base wo_options cmocka m)
add_test(NAME unit.depth_channel COMMAND test_depth_channel)

# A picture from file to file: what colours it is in, and what it says of that.
add_executable(test_output ${CMAKE_CURRENT_LIST_DIR}/test_output.c
    ${cli}/picture_file.c ${cli}/render_output.c)
target_compile_definitions(test_output PRIVATE _POSIX_C_SOURCE=200809L)
target_include_directories(test_output PRIVATE
    ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/ofx_host_stub)
target_link_libraries(test_output PRIVATE wo_bridge wo_base wo_options cmocka m)
add_test(NAME unit.output COMMAND test_output)

# What the page of a lens says, against a tracer of the test's own.
add_executable(test_lens_curves ${CMAKE_CURRENT_LIST_DIR}/test_lens_curves.c
    ${cli}/lens_beam.c ${cli}/lens_bundle.c ${cli}/lens_curves.c ${cli}/lens_view.c)
target_compile_definitions(test_lens_curves PRIVATE _POSIX_C_SOURCE=200809L)
target_include_directories(test_lens_curves PRIVATE
    ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/tests/property ${cli})
target_link_libraries(test_lens_curves PRIVATE wo_core wo_options cmocka m)
add_test(NAME unit.lens_curves COMMAND test_lens_curves)
set_tests_properties(unit.lens_curves PROPERTIES TIMEOUT 300)
