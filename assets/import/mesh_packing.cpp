#include "assets/import/mesh_packing.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

namespace vicus::assets {
namespace {

/// Values as bytes, one after another.
struct Packed {
  std::string bytes;
  template <typename T>
  void plain(const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void text(const std::string& value) {
    plain(value.size());
    bytes += value;
  }
  template <typename T>
  void list(const std::vector<T>& values) {
    plain(values.size());
    if (!values.empty()) bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
};

/// The inverse; reads nothing beyond its bytes.
struct Unpacked {
  std::string_view rest;
  bool take(void* to, size_t size) {
    if (size > rest.size()) return false;
    if (size > 0) std::memcpy(to, rest.data(), size);
    rest.remove_prefix(size);
    return true;
  }
  template <typename T>
  T plain() {
    T value{};
    take(&value, sizeof value);
    return value;
  }
  std::string text() {
    std::string value(std::min(plain<size_t>(), rest.size()), '\0');
    take(value.data(), value.size());
    return value;
  }
  template <typename T>
  std::vector<T> list() {
    std::vector<T> values(std::min(plain<size_t>(), rest.size() / sizeof(T)));
    take(values.data(), values.size() * sizeof(T));
    return values;
  }
};

}  // namespace

std::string pack(const std::optional<MeshContent>& content, const city::Diagnostics& diagnostics) {
  Packed out;
  out.plain(diagnostics.messages.size());
  for (const city::Diagnostic& d : diagnostics.messages) {
    out.plain(d.severity);
    out.text(d.file), out.text(d.place), out.text(d.message);
  }
  out.plain(content.has_value());
  if (!content) return std::move(out.bytes);
  out.list(content->mesh.vertices), out.list(content->mesh.indices);
  out.plain(content->materials.size());
  for (const SourceMaterial& m : content->materials) {
    out.text(m.name), out.text(m.image);
    out.plain(m.colour), out.plain(m.repeat);
  }
  return std::move(out.bytes);
}

std::optional<MeshContent> unpack(std::string_view bytes, city::Diagnostics& diagnostics) {
  Unpacked in{bytes};
  for (size_t n = in.plain<size_t>(); n > 0 && !in.rest.empty(); --n) {
    city::Diagnostic& d = diagnostics.messages.emplace_back();
    d.severity = in.plain<city::Severity>();
    d.file = in.text(), d.place = in.text(), d.message = in.text();
  }
  if (!in.plain<bool>()) return std::nullopt;
  MeshContent content;
  content.mesh.vertices = in.list<city::Vertex>(), content.mesh.indices = in.list<uint32_t>();
  for (size_t n = in.plain<size_t>(); n > 0 && !in.rest.empty(); --n) {
    SourceMaterial& m = content.materials.emplace_back();
    m.name = in.text(), m.image = in.text();
    m.colour = in.plain<glm::vec3>(), m.repeat = in.plain<bool>();
  }
  return content;
}

}  // namespace vicus::assets
