/// The program's commands. Each returns an exit code.
#pragma once

#include <span>
#include <string>

#include "app/console.hpp"
#include "app/options.hpp"

namespace vicus::app {

/// The whole program: reads the arguments (without the program's name) and runs the command that they name.
int run(std::span<const std::string> arguments, const Surroundings& surroundings);

/// Walks in a window, or draws offscreen.
int walk(const WalkOptions& options, const Surroundings& surroundings);
/// Renders a tour offscreen, every frame of it: to `options.film` where that is a video file's name, else to pictures
/// in a folder of that name.
int film(const WalkOptions& options, const Surroundings& surroundings);
/// A first scene description for data files.
int importScene(const ImportOptions& options, const Surroundings& surroundings);
/// What a scene holds.
int info(const InfoOptions& options, const Surroundings& surroundings);
/// Every knob.
int knobs(bool json, const Surroundings& surroundings);
/// Error against run time: report.html, report.json and report.csv in a folder.
int report(const ReportCommandOptions& options, const Surroundings& surroundings);
/// Whether culling loses anything: item buffers and pictures with and without it, over random views.
int check(const CheckOptions& options, const Surroundings& surroundings);

}  // namespace vicus::app
