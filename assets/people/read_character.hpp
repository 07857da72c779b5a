/// Skinned characters in glTF, FBX and COLLADA.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "city/avatars.hpp"
#include "city/diagnostics.hpp"

namespace vicus::assets::people {

struct CharacterFile {
  city::Character body;           ///< with a clip for each role
  std::vector<city::Clip> clips;  ///< all of the file, by its own names
};

/// Reads a character with assimp, in a process of its own. Its y becomes up and its +z ahead; one taller than 2.3 m or
/// smaller than 0.3 m is brought to 1.7 m. Colours are those of the textures at the vertices. Meshes without skin hang
/// on their nodes; what hands hold is left out. Roles take the clips whose names say so (walk, idle, talk, carry
/// or pick); what is missing is made from our own motions by the bones' names. Nothing, with an error that names the
/// file and what is wrong, where it holds no mesh with a skeleton or is damaged.
std::optional<CharacterFile> readCharacter(const std::string& file, city::Diagnostics& diagnostics);

/// Puts a recorded motion in the place of a character's walk: retargeted, cut to a cycle, settled on the ground,
/// compressed to a millimetre. False, with a warning, where it holds no cycle or the bones do not match.
bool useMotion(city::Character& character, const city::Skeleton& skeleton, const city::Clip& clip,
               const std::string& file, city::Diagnostics& diagnostics);

}  // namespace vicus::assets::people
