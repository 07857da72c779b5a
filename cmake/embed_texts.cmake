# cmake -DOUTPUT=FILE -DFUNCTION=shaderText -DHEADER=assets/shaders/shaders.hpp -DFILES="a.glsl;b.vert" -P embed_texts.cmake
# Writes a C++ file that defines vicus::assets::FUNCTION(fileName): each file as a raw string.
set(text "// Made by cmake/embed_texts.cmake.\n#include \"${HEADER}\"\n\nnamespace vicus::assets {\n\n")
string(APPEND text "std::string_view ${FUNCTION}(std::string_view fileName) {\n")
foreach(file ${FILES})
  get_filename_component(name ${file} NAME)
  file(READ ${file} source)
  string(APPEND text "  if (fileName == \"${name}\")\n    return R\"text(${source})text\";\n")
endforeach()
string(APPEND text "  return {};\n}\n\n}  // namespace vicus::assets\n")
file(WRITE ${OUTPUT} "${text}")
