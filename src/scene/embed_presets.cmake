# Compiles example scenes of docs/scenes into the library, so that each preset has one text.
# The classic scene first.
set(carom_presets box barometer bouncing_ball bouncing_on_a_sine brownian brownian_dynamics cavity channel clusters compression couette defects
                  dense dense_mixture diffusion dilute_gas drag drum free_expansion galperin galton gas granular_column
                  granular_gas growth heat_fluctuations heated_walls hourglass jarzynski leidenfrost lorentz lorentz_wide
                  maxwells_demon maxwells_door mixture mushroom newtons_cradle non_additive observe piston poiseuille polydisperse rough shear sinai
                  square_well stadium stepped thermostat tumbling two_disks vibrated)

list(TRANSFORM carom_presets REPLACE "(.+)" "docs/scenes/\\1.toml" OUTPUT_VARIABLE carom_preset_files)
carom_embed_texts(carom preset_texts ${carom_preset_files})
