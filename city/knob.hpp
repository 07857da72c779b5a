/// Settings that a report sweeps or a user turns. Each has one home, one default, one sentence.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vicus::city {

/// The declaration of one knob. Switches have the unit "on/off" and the values 0 and 1.
struct Knob {
  std::string_view name;  ///< "frustum_culling", "viewer.multisamples"
  double value = 0;       ///< default
  double min = 0, max = 1;
  std::string_view unit;
  std::string_view meaning;   ///< one sentence
  std::string_view tooSmall;  ///< what too small a value does
  std::string_view tooLarge;

  bool isSwitch() const { return unit == "on/off"; }
};

/// The current values of a list of declared knobs.
class Knobs {
 public:
  Knobs() = default;
  /// Adds declarations at their defaults. A name declared twice is a broken precondition.
  void declare(std::span<const Knob> knobs);

  /// Value of a declared knob; asking for one that is not declared is a broken precondition.
  double operator[](std::string_view name) const;
  bool on(std::string_view name) const { return (*this)[name] != 0; }
  bool has(std::string_view name) const;

  /// Sets a knob; an empty result is success, else it says what is wrong (unknown name with the nearest known one, out
  /// of range).
  std::string set(std::string_view name, double value);
  /// Parses "name=value"; switches also take on and off.
  std::string set(std::string_view assignment);

  const std::vector<Knob>& declared() const { return declared_; }

 private:
  std::vector<Knob> declared_;
  std::map<std::string, double, std::less<>> values_;
};

}  // namespace vicus::city
