#include <filesystem>
#include <fstream>

#include "app/commands.hpp"
#include "app/open_scene.hpp"
#include "assets/scene/write_scene.hpp"

namespace vicus::app {

int importScene(const ImportOptions& options, const Surroundings& surroundings) {
  Console console(surroundings);
  std::error_code error;
  if (!options.overwrite && std::filesystem::exists(options.out, error)) {
    console.error(options.out + " exists already: name another file, or add --overwrite");
    return kCouldNot;
  }
  assets::LoadOptions load = loadOptions(options.scene, surroundings, console);
  load.cacheFolder.clear();
  const assets::DraftScene draft = assets::draftScene(options.scene.inputs, load, options.out);
  console.progressDone();
  console.report(draft.diagnostics);
  if (draft.text.empty()) {
    console.error("nothing to describe");
    return kCouldNot;
  }
  std::ofstream stream(options.out, std::ios::binary);
  stream << draft.text << std::flush;
  if (!stream) {
    console.error(options.out + " cannot be written");
    return kCouldNot;
  }
  console.say(options.out + " written; next: vicus walk " + options.out);
  return kDone;
}

}  // namespace vicus::app
