#pragma once
// The whole engine: what a file includes that makes one. event_loop.hpp is the loop; it and engine.hpp declare what these files
// define.

#include "engine/engine_begin.hpp"
#include "engine/engine_check.hpp"
#include "engine/engine_epochs.hpp"
#include "engine/engine_lists.hpp"
#include "engine/engine_outside.hpp"
#include "engine/engine_plans.hpp"
#include "engine/engine_shear.hpp"
