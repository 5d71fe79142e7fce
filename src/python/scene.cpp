// Scenes, as Python sees them.

#include "python/buffers.hpp"
#include "python/parts.hpp"
#include "scene/presets.hpp"
#include "scene/start_file.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace carom::python {

namespace {

std::vector<Eigen::Vector2d> pairs_of(const std::optional<Pairs>& array) {
  std::vector<Eigen::Vector2d> pairs;
  if (!array) return pairs;
  pairs.reserve(array->shape(0));
  for (std::size_t i = 0; i < array->shape(0); ++i) pairs.emplace_back((*array)(i, 0), (*array)(i, 1));
  return pairs;
}

std::vector<double> numbers_of(const std::optional<Numbers>& array) {
  if (!array) return {};
  return {array->data(), array->data() + array->shape(0)};
}

}  // namespace

void add_scene(nb::module_& module) {
  nb::class_<Scene>(module, "Scene")
      .def_static("load", &load_scene, nb::arg("path"), nb::arg("overrides") = std::vector<std::string>{})
      .def_static("parse", &parse_scene, nb::arg("text"), nb::arg("source"), nb::arg("overrides") = std::vector<std::string>{},
                  nb::arg("directory") = ".")
      .def(
          "with_disks",
          [](const Scene& scene, const Pairs& positions, const std::optional<Pairs>& velocities,
             const std::optional<Numbers>& radii, const std::optional<Numbers>& masses) {
            return with_disks(scene, {pairs_of(positions), pairs_of(velocities), numbers_of(radii), numbers_of(masses)});
          },
          nb::arg("positions"), nb::arg("velocities").none(), nb::arg("radii").none(), nb::arg("masses").none())
      .def_prop_ro("toml", [](const Scene& scene) { return resolved_toml(scene); })
      .def_ro("text", &Scene::text)
      .def_ro("overrides", &Scene::overrides)
      .def_ro("source", &Scene::source)
      .def_ro("title", &Scene::title)
      .def_prop_ro("count", &Scene::disk_count)
      .def_prop_ro("packing_fraction", &Scene::packing_fraction)
      .def_prop_ro("seed", [](const Scene& scene) { return scene.run.seed; })
      .def_prop_ro("sample_every", [](const Scene& scene) { return scene.run.sample_every; })
      .def_prop_ro("lower",
                   [](const Scene& scene) {
                     return std::vector<double>{scene.box.lower.x(), scene.box.lower.y()};
                   })
      .def_prop_ro("upper",
                   [](const Scene& scene) {
                     return std::vector<double>{scene.box.upper.x(), scene.box.upper.y()};
                   })
      .def_prop_ro("periodic",
                   [](const Scene& scene) {
                     return std::vector<bool>{scene.box.periodic(0), scene.box.periodic(1)};
                   })
      .def_prop_ro("circle",
                   [](const Scene& scene) -> std::optional<std::tuple<std::vector<double>, double>> {
                     if (!scene.effects.circle) return std::nullopt;
                     return std::tuple{std::vector<double>{scene.effects.circle->centre.x(), scene.effects.circle->centre.y()},
                                       scene.effects.circle->radius};
                   })
      .def_prop_ro("species",
                   [](const Scene& scene) {
                     std::vector<std::string> names;
                     for (const Species& species : scene.species) names.push_back(species.name);
                     return names;
                   })
      .def_prop_ro("observables", [](const Scene& scene) {
        std::vector<std::string> names;
        for (const ObservableRequest& request : scene.observe) names.push_back(request.name);
        return names;
      });
  module.def(
      "read_start_file",
      [](const std::string& path) {
        detail::StartFile start = detail::read_start_file(path);
        const auto columns = [](std::vector<Eigen::Vector2d>& values) {
          const std::size_t count = values.size();
          return array_that_owns<double>(std::move(values), {count, 2});
        };
        const auto column = [](std::vector<double>& values) {
          const std::size_t count = values.size();
          return array_that_owns<double>(std::move(values), {count});
        };
        return std::tuple(columns(start.positions), columns(start.velocities), column(start.radii), column(start.masses));
      },
      nb::arg("path"), "Returns positions, velocities, radii and masses; a column that the file has not is empty.");
  module.def("preset_names", &preset_names, "Returns the names of all presets, \"box\" first.");
  module.def("preset", &preset, nb::arg("name"), "Returns the TOML text of a preset.");
  module.def("engine_names", &engine_names, "Returns the names of all engines, the preferred ones first.");
  module.def("fixed_step_names", &fixed_step_names, "Returns the names of all fixed-step methods.");
}

}  // namespace carom::python
