// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>

#include <string>

// Measurements, and the table of ratios that they make.

namespace kinefile::bench {

/// What is measured: the time of the processor, which other programs on the machine disturb less,
/// or that of the clock, where several threads work.
enum class Time { Processor, Clock };

/// Adds a measurement. All of them run in turns, so that a machine whose speed drifts slows all of
/// them alike.
void measure(const std::string& name, void (*function)(benchmark::State&),
             Time time = Time::Processor);

/// Adds a line to the table: how many times as fast one measurement is as another.
void compare(const std::string& what, const std::string& ours, const std::string& baseline);

/// Runs the measurements that the arguments select, and prints the lines whose measurements ran.
/// \returns  whether the arguments are valid
bool run_and_print(int argc, char** argv);

}  // namespace kinefile::bench
