# cmake -DOUT=FILE -DSOURCES=a;b;… -P builder_version.cmake: writes a C++ file with a hash of the sources.
set(all "")
foreach(source ${SOURCES})
  file(SHA256 ${source} hash)
  string(APPEND all ${hash})
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 16 hash)
file(CONFIGURE OUTPUT ${OUT} CONTENT "#include \"assets/cache/builder_version.hpp\"

namespace vicus::assets {
const char* const kBuilderVersion = \"@hash@\";
}  // namespace vicus::assets
" @ONLY)
