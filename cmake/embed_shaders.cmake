# cmake -DOUTPUT=FILE -DSHADERS="a.glsl;b.vert" -P embed_shaders.cmake
# Writes a C++ file that defines vicus::assets::shaderText: each shader as a raw string.
set(text "// Made from assets/shaders by cmake/embed_shaders.cmake.\n#include \"assets/shaders/shaders.hpp\"\n\nnamespace vicus::assets {\n\n")
string(APPEND text "std::string_view shaderText(std::string_view fileName) {\n")
foreach(shader ${SHADERS})
  get_filename_component(name ${shader} NAME)
  file(READ ${shader} source)
  string(APPEND text "  if (fileName == \"${name}\")\n    return R\"glsl(${source})glsl\";\n")
endforeach()
string(APPEND text "  return {};\n}\n\n}  // namespace vicus::assets\n")
file(WRITE ${OUTPUT} "${text}")
