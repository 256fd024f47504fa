// The person at the terminal: what they see, and how they interrupt.
#pragma once

#include <string_view>

namespace roomlight {

// Whether stderr is read by a person, or goes to a file.
bool isErrorOutputTerminal();

bool isOutputOpen();
// To stdout past stdio, which would try again at the end what could not be written. A reader that is gone is an error
// here, not the program's end without a word. errno; 0: done.
int writeToOutput(std::string_view text);

// Calls this, in the thread that is disturbed, for Ctrl-C, a request to end, and a terminal that closes unless the
// program is to outlive it; with the signal's number. Only what a signal handler may do.
void onInterruption(void (*handler)(int number));

}  // namespace roomlight
