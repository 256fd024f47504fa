// What this process asks of its machine, and what it may take of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ctime>
#include <span>
#include <string>

namespace roomlight {

std::string hostName();  // empty where there is none

// Tells machines apart, and boots and containers of one: process numbers of two are of the same when it is equal.
std::string machineIdentity();

double installedMemoryBytes();  // of the machine
double machineLoad();           // processes that ran or waited for a core, mean of the last minute; 0: not known

// The time of day here, by the clock on the wall.
std::tm localTime(std::time_t time);

// Cores that this process may run on; 1 where that is not known.
int coresAllowed();

// Processor time of all threads of this process so far.
double processCpuSeconds();

// The most memory this process has held so far, in MiB.
double peakMemoryMiB();

// No more data than so many bytes, or the hard limit if that is less: allocations fail beyond. errno; 0: done.
int limitData(double bytes);

// Nice to others: this thread alone, where the system can. Where it cannot be set the thread goes on as before.
void giveWay();

// Random bytes that nobody can guess; throws std::system_error.
void fillWithRandomBytes(std::span<unsigned char> bytes);

// How often the kernel has killed for want of memory in this process's control group.
uint64_t outOfMemoryKills();

}  // namespace roomlight
