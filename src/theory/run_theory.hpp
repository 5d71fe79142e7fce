#pragma once
// Theoretical values for the results of a run: for numbers that it measured and for the curves in its tables. They exist only
// where the theory holds in this scene: equal elastic disks in equilibrium, and nothing else that acts. Nothing here is a
// verdict; `carom validate` gives those.

#include "observe/run_report.hpp"

#include <carom/observe.hpp>
#include <carom/scene.hpp>

#include <optional>
#include <string>
#include <vector>

namespace carom {

struct Expected {
  double value = 0.0;
  std::string source;  ///< a few words: the source of the theory
};

/// A curve that a theory gives for a column of a table. It is dashed where it is an approximation or stands beside a better one.
struct TheoryCurve {
  std::string name;
  bool dashed = false;
  std::vector<double> x = {}, y = {};
};

/// A value that a column comes to, or a place on its first column.
struct TheoryMark {
  bool on_first_column = false;
  double value = 0.0;
  std::string label;
};

/// The scene of a run that is read back, and its disks.
struct TheorySource {
  const Scene& scene;
  const Disks& disks;
  std::size_t species = 1;
};

class RunTheory {
 public:
  /// `report` and what `source` refers to must live as long as this. Without a source there is no theory.
  RunTheory(const RunReport& report, std::optional<TheorySource> source);

  /// Returns the expected value of a number of [observe].
  [[nodiscard]] std::optional<Expected> of(const std::string& observable, const std::string& scalar) const;
  /// Z after Kolafa and Rottner, for so many disks where its first term in 1/N is known; why_not_Z() says why there is none.
  [[nodiscard]] std::optional<Expected> Z() const { return Z_; }
  [[nodiscard]] const std::string& why_not_Z() const { return why_not_Z_; }  ///< a sentence

  /// Lines that belong to a column of a table ("density", "density_small", "diffusion", ...).
  [[nodiscard]] std::vector<TheoryCurve> curves(const Table& table, const std::string& column) const;
  /// Values that it comes to.
  [[nodiscard]] std::vector<TheoryMark> marks(const Table& table, const std::string& column) const;

 private:
  /// Disks of one mass.
  struct Kind {
    double mass = 0.0, count = 0.0;
  };
  enum class Velocities { unknown, fixed_energy, maxwell };

  void find_velocities();
  void find_Z();
  [[nodiscard]] std::vector<Kind> kinds(const std::string& suffix) const;
  [[nodiscard]] double velocity_density(const Kind& kind, double x, bool of_energy) const;
  [[nodiscard]] std::vector<TheoryCurve> velocity_curves(const Table& table, const std::string& column) const;
  [[nodiscard]] std::vector<TheoryCurve> flight_curves(const Table& table) const;
  [[nodiscard]] std::vector<TheoryCurve> density_curves(const Table& table) const;

  const RunReport& report_;
  std::optional<TheorySource> source_;
  bool is_plain_ = false;   ///< equal disks, periodic, nothing acts but the rule
  bool is_smooth_ = false;  ///< and the rule is specular
  Velocities velocities_ = Velocities::unknown;
  int conserved_axes_ = 0;         ///< along which momentum is conserved
  bool moves_as_a_whole_ = false;  ///< along an axis on which momentum is conserved: speeds and ways contain that
  double kT_ = 0.0, eta_ = 0.0, mass_ = 1.0, sigma_ = 1.0;
  double unit_of_time_ = 1.0;  ///< sigma sqrt(m / kT)
  std::optional<Expected> Z_;
  std::string why_not_Z_;
};

}  // namespace carom
