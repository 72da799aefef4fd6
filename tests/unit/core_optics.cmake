# Unit tests of core/optics, core/focus and core/defocus.
foreach(name IN ITEMS
        thin_lens aperture aperture_shapes aperture_kernel depth depth_check sheet sheet_edges sheet_depth stack
        march accumulate filter hybrid highlights point_image point_spread diagram pencil_map glass prescription
        prescription_designs prescription_fuzz focus pencil_tilt lens_first_order lens_trace lens_seidel lens_table
        lens_models lens_extremes lens_lit)
    add_executable(test_${name} ${CMAKE_CURRENT_LIST_DIR}/test_${name}.c)
    target_link_libraries(test_${name} PRIVATE wo_test_scenes)
    add_test(NAME unit.${name} COMMAND test_${name})
    set_tests_properties(unit.${name} PROPERTIES TIMEOUT 300)
endforeach()
target_compile_definitions(test_prescription PRIVATE
    WO_LENS_PAGE="${PROJECT_SOURCE_DIR}/core/optics/lens_format.md")
