/// What measuring itself costs a frame. Read it beside the frame's milliseconds: docs/report.md.
#include <benchmark/benchmark.h>

#include "scenegraph/gl.hpp"
#include "viewer/frame_loop.hpp"
#include "viewer/renderer.hpp"

namespace {

using namespace vicus;

/// As many stages as a frame of a town has.
constexpr std::string_view kStages[] = {"input",
                                        "frustum tiles",
                                        "frustum buildings",
                                        "frustum trees",
                                        "frustum monuments",
                                        "cull map",
                                        "apply buildings",
                                        "apply monuments",
                                        "apply trees",
                                        "apply terrain",
                                        "apply ground",
                                        "apply sky",
                                        "apply water",
                                        "update",
                                        "cull",
                                        "draw",
                                        "finish",
                                        "swap"};

/// A clock for each stage and the record kept: all that measuring adds on the processor.
void noteAFrame(benchmark::State& state) {
  std::vector<viewer::FrameRecord> records;
  records.reserve(1 << 12);
  for (auto _ : state) {
    viewer::FrameRecord record;
    viewer::StageClock clock;
    for (const std::string_view stage : kStages) record.stages.add(stage, clock.lap());
    if (records.size() == records.capacity()) records.clear();
    records.push_back(record);
    benchmark::DoNotOptimize(records.data());
  }
}
BENCHMARK(noteAFrame);

/// The two queries of the card's clock, asked after glFinish as in a frame.
void askTheCard(benchmark::State& state) {
  std::string error;
  const auto context = viewer::makeOffscreenContext(error);
  if (!context) {
    state.SkipWithError(error.c_str());
    return;
  }
  context->makeCurrent();
  GLuint queries[2] = {};
  glGenQueries(2, queries);
  const bool asked = state.range(0) != 0;
  for (auto _ : state) {
    if (asked) glQueryCounter(queries[0], GL_TIMESTAMP);
    if (asked) glQueryCounter(queries[1], GL_TIMESTAMP);
    glFinish();
    GLuint64 at[2] = {};
    if (asked)
      for (int k = 0; k < 2; ++k) glGetQueryObjectui64v(queries[k], GL_QUERY_RESULT, &at[k]);
    benchmark::DoNotOptimize(at);
  }
  glDeleteQueries(2, queries);
}
BENCHMARK(askTheCard)->ArgName("asked")->Arg(0)->Arg(1);

}  // namespace
