#include "twin/command_line.h"

int main(int argc, char** argv) { return thermotwin::twin::command_line(argc, argv); }
