#include "import/model_reader.h"

int main(int argc, char** argv) { roomlight::importers::modelReaderMain(argc, argv); }
