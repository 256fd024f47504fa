// roomlight: light in a home, from the command line.
#include <roomlight/program.h>

int main(int argc, char** argv) { return roomlight::runProgram(argc, argv); }
