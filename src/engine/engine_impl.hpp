#pragma once
// The whole engine: what a file includes that makes one. engine.hpp is the loop, and declares what these files define.

#include "engine/engine_archive.hpp"
#include "engine/engine_begin.hpp"
#include "engine/engine_check.hpp"
#include "engine/engine_epochs.hpp"
#include "engine/engine_lists.hpp"
#include "engine/engine_outside.hpp"
#include "engine/engine_plans.hpp"
#include "engine/engine_shear.hpp"
