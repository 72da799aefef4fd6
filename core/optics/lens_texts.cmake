# Writes the C file that holds the texts of FILES (a list with | between) as wo_lens_texts.
# usage: cmake -D FILES=A.lens|B.lens -D OUTPUT=lens_texts.c -P lens_texts.cmake
string(REPLACE "|" ";" files "${FILES}")
set(texts "")
set(rows "")
set(number 0)
foreach(file IN LISTS files)
    get_filename_component(name ${file} NAME_WE)
    file(READ ${file} text)
    string(REPLACE "\\" "\\\\" text "${text}")
    string(REPLACE "\"" "\\\"" text "${text}")
    string(REPLACE "\r" "" text "${text}")
    string(REPLACE "\n" "\\n\"\n    \"" text "${text}")
    string(APPEND texts "static const char text_${number}[] =\n    \"${text}\";\n\n")
    string(APPEND rows "    {\"${name}\", text_${number}},\n")
    math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUTPUT}
    "/* Made by lens_texts.cmake from footage/lenses. */\n"
    "#include \"optics/prescription_private.h\"\n\n"
    "${texts}const wo_lens_text wo_lens_texts[] = {\n${rows}};\n"
    "const size_t wo_lens_text_count = WO_COUNT(wo_lens_texts);\n")
