#pragma once
// The whole public interface of Carom.

#include <carom/blocking.hpp>
#include <carom/observe.hpp>
#include <carom/ranks.hpp>
#include <carom/scene.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>
#include <carom/threads.hpp>
#include <carom/version.hpp>
