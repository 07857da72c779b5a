#include "viewer/film.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

namespace vicus::viewer {
namespace {

std::string reasonOf(int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  return text.data();
}

}  // namespace

struct Film::Impl {
  std::filesystem::path path, part;
  glm::ivec2 size{0};
  AVFormatContext* format = nullptr;
  AVCodecContext* codec = nullptr;
  AVStream* stream = nullptr;
  AVFrame* frame = nullptr;
  AVPacket* packet = nullptr;
  SwsContext* scaler = nullptr;
  int64_t next = 0;
  bool finished = false;

  ~Impl() {
    sws_freeContext(scaler);
    av_packet_free(&packet);
    av_frame_free(&frame);
    avcodec_free_context(&codec);
    if (format && format->pb) avio_closep(&format->pb);
    avformat_free_context(format);
    std::error_code ignored;
    if (!finished && !part.empty()) std::filesystem::remove(part, ignored);
  }

  std::string say(const std::string& what) const { return path.string() + ": " + what; }

  std::string openEncoder(double rate) {
    const AVCodec* encoder = avcodec_find_encoder_by_name("libx264");
    const bool takesH264 = avformat_query_codec(format->oformat, AV_CODEC_ID_H264, FF_COMPLIANCE_NORMAL) == 1;
    if (!encoder || !takesH264) encoder = avcodec_find_encoder(format->oformat->video_codec);
    if (!encoder) return say("this libav has no encoder for such files");
    stream = avformat_new_stream(format, nullptr);
    codec = avcodec_alloc_context3(encoder);
    if (!stream || !codec) return say("no memory for the encoder");
    constexpr int kThreads = 4;  // fixed, since the bytes depend on it
    codec->width = size.x, codec->height = size.y;
    codec->pix_fmt = AV_PIX_FMT_YUV420P;
    codec->framerate = av_d2q(rate, 100'000);
    codec->time_base = av_inv_q(codec->framerate);
    codec->thread_count = kThreads;
    codec->color_range = AVCOL_RANGE_MPEG;
    codec->colorspace = AVCOL_SPC_BT709;
    codec->color_primaries = AVCOL_PRI_BT709;
    codec->color_trc = AVCOL_TRC_BT709;
    codec->flags |= AV_CODEC_FLAG_BITEXACT;
    format->flags |= AVFMT_FLAG_BITEXACT;
    if (format->oformat->flags & AVFMT_GLOBALHEADER) codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    // Nearly without visible loss; encoders that do not know these take their own.
    av_opt_set(codec->priv_data, "crf", "18", 0);
    av_opt_set(codec->priv_data, "preset", "medium", 0);
    if (const int code = avcodec_open2(codec, encoder, nullptr); code < 0)
      return say("the encoder does not start: " + reasonOf(code));
    stream->time_base = codec->time_base;
    stream->avg_frame_rate = codec->framerate;
    avcodec_parameters_from_context(stream->codecpar, codec);
    return {};
  }

  std::string open(double rate) {
    const AVOutputFormat* kind = av_guess_format(nullptr, path.string().c_str(), nullptr);
    if (!kind) return say("no kind of video file that libav knows");
    if (avformat_alloc_output_context2(&format, kind, nullptr, part.string().c_str()) < 0 || !format)
      return say("no memory for the file");
    if (std::string problem = openEncoder(rate); !problem.empty()) return problem;
    if (const int code = avio_open(&format->pb, part.string().c_str(), AVIO_FLAG_WRITE); code < 0)
      return say("cannot be written: " + reasonOf(code));
    if (const int code = avformat_write_header(format, nullptr); code < 0)
      return say("cannot be written: " + reasonOf(code));
    frame = av_frame_alloc();
    packet = av_packet_alloc();
    frame->format = codec->pix_fmt, frame->width = size.x, frame->height = size.y;
    if (av_frame_get_buffer(frame, 0) < 0) return say("no memory for a picture");
    scaler = sws_getContext(size.x, size.y, AV_PIX_FMT_RGB24, size.x, size.y, codec->pix_fmt,
                            SWS_BICUBIC | SWS_ACCURATE_RND | SWS_BITEXACT, nullptr, nullptr, nullptr);
    if (!scaler) return say("pictures cannot be converted");
    const int* const bt709 = sws_getCoefficients(SWS_CS_ITU709);
    sws_setColorspaceDetails(scaler, bt709, 1, bt709, 0, 0, 1 << 16, 1 << 16);
    return {};
  }

  /// Hands a frame (null: no more) to the encoder and writes what comes out.
  std::string encode(const AVFrame* from) {
    int code = avcodec_send_frame(codec, from);
    while (code >= 0) {
      code = avcodec_receive_packet(codec, packet);
      if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return {};
      if (code < 0) break;
      packet->stream_index = stream->index;
      av_packet_rescale_ts(packet, codec->time_base, stream->time_base);
      code = av_interleaved_write_frame(format, packet);
    }
    return say("encoding failed: " + reasonOf(code));
  }
};

bool isFilmName(const std::filesystem::path& path) {
  constexpr std::string_view kKinds[] = {".mp4", ".mkv", ".mov", ".webm"};
  return std::find(std::begin(kKinds), std::end(kKinds), path.extension().string()) != std::end(kKinds);
}

Film::Film(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Film::~Film() = default;

std::unique_ptr<Film> Film::open(const std::filesystem::path& path, glm::ivec2 size, double rate, std::string& error) {
  av_log_set_level(AV_LOG_ERROR);
  auto impl = std::make_unique<Impl>();
  impl->path = impl->part = path;
  impl->part += ".part";
  impl->size = glm::ivec2(size.x & ~1, size.y & ~1);
  error.clear();
  if (impl->size.x < 2 || impl->size.y < 2) error = impl->say("pictures of less than 2 × 2 pixels make no film");
  if (!(rate >= 0.01 && rate <= 1000)) error = impl->say("a film has 0.01 to 1000 pictures a second");
  std::error_code failed;
  if (error.empty() && path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), failed);
  if (failed) error = impl->say("the folder cannot be made: " + failed.message());
  if (error.empty()) error = impl->open(rate);
  if (!error.empty()) return nullptr;
  return std::unique_ptr<Film>(new Film(std::move(impl)));
}

std::string Film::add(const Picture& picture) {
  Impl& f = *impl_;
  const size_t bytes =
      3 * static_cast<size_t>(std::max(picture.width, 0)) * static_cast<size_t>(std::max(picture.height, 0));
  if (picture.rgb.size() != bytes || (picture.width & ~1) != f.size.x || (picture.height & ~1) != f.size.y)
    return f.say("a picture of " + std::to_string(picture.width) + " × " + std::to_string(picture.height) +
                 " in a film of " + std::to_string(f.size.x) + " × " + std::to_string(f.size.y));
  if (const int code = av_frame_make_writable(f.frame); code < 0) return f.say("no memory: " + reasonOf(code));
  const uint8_t* const from[] = {picture.rgb.data()};
  const int stride[] = {3 * picture.width};
  sws_scale(f.scaler, from, stride, 0, f.size.y, f.frame->data, f.frame->linesize);
  f.frame->pts = f.next++;
  return f.encode(f.frame);
}

std::string Film::finish() {
  Impl& f = *impl_;
  if (std::string problem = f.encode(nullptr); !problem.empty()) return problem;
  if (const int code = av_write_trailer(f.format); code < 0) return f.say("cannot be finished: " + reasonOf(code));
  if (const int code = avio_closep(&f.format->pb); code < 0) return f.say("cannot be finished: " + reasonOf(code));
  std::error_code failed;
  std::filesystem::rename(f.part, f.path, failed);
  if (failed) return f.say("cannot be finished: " + failed.message());
  f.finished = true;
  return {};
}

}  // namespace vicus::viewer
