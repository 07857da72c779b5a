/// What is wrong with a glTF file, and where in it: for those who must be told why it could not be read.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vicus::assets::gltf {

struct Fault {
  std::string place;  ///< a byte of the file, or a JSON pointer
  std::string what;
};

/// The first fault of a glTF text or binary (the whole of it, in `bytes`); nothing where none is found. Looked at: the
/// binary's header and chunks, the JSON's syntax, and that buffers, views, accessors, meshes, nodes, skins and
/// animations lie within each other and name what there is. Never throws.
/// Based on: Khronos glTF 2.0 specification, §3.5 to §3.11, §4.4.
std::optional<Fault> firstFault(std::string_view bytes);

/// The same of a file; nothing, too, where it cannot be opened or is no *.gltf or *.glb by its name.
std::optional<Fault> firstFaultIn(const std::string& file);

}  // namespace vicus::assets::gltf
