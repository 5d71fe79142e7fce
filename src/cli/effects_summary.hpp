#pragma once
// What the effects of a scene have done, as rows of the summary on the terminal. Nothing for effects that the scene does not
// name.

#include "observe/run_report.hpp"

#include <carom/scene.hpp>

#include <string>

namespace carom::cli {

/// Counts of what happens beside collisions of pairs and with walls.
std::string rows_of_events(const RunReport& report);

/// The row of energy: its drift, or where effects give and take, how much of its change is explained.
std::string row_of_energy(const RunReport& report);

/// What walls, thermostat, growth, shear and wells gave, took and measured.
std::string rows_of_effects(const RunReport& report, const Scene& scene);

}  // namespace carom::cli
