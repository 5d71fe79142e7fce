#pragma once
// All of Carom's public interface.

#include <carom/scene.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>
#include <carom/version.hpp>
