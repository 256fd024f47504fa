// Lets other threads go before this one.
#pragma once

#include <sys/resource.h>
#include <unistd.h>

namespace roomlight {

// On Linux niceness is a thread's own. Where it cannot be set the thread goes on as before.
inline void giveWay() { setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), 10); }

}  // namespace roomlight
