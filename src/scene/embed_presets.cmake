# Compiles example scenes of docs/scenes into the library, so that each preset has one text. A changed scene is
# embedded again by the next build.
# The classic scene first.
set(carom_presets box barometer bouncing_ball brownian channel clusters compression dense dense_mixture diffusion dilute_gas
                  free_expansion galperin galton gas granular_column granular_gas growth heated_walls hourglass lorentz
                  lorentz_wide maxwells_door mixture newtons_cradle observe piston rough shear sinai square_well thermostat
                  two_disks)

set(carom_preset_entries "")
foreach(preset IN LISTS carom_presets)
  set(preset_file ${CMAKE_CURRENT_LIST_DIR}/../../docs/scenes/${preset}.toml)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${preset_file})
  file(READ ${preset_file} preset_toml)
  string(APPEND carom_preset_entries "    {\"${preset}\", R\"scene(${preset_toml})scene\"},\n")
endforeach()
list(LENGTH carom_presets carom_preset_count)
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/scene/preset_texts.cpp @ONLY CONTENT [=[
// Written by embed_presets.cmake from docs/scenes.
#include "scene/preset_texts.hpp"

#include <array>

namespace carom::detail {
namespace {

constexpr std::array<PresetText, @carom_preset_count@> texts = {{
@carom_preset_entries@}};

}  // namespace

std::span<const PresetText> preset_texts() { return texts; }

}  // namespace carom::detail
]=])
target_sources(carom PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/scene/preset_texts.cpp)
