// SPDX-License-Identifier: MIT
#pragma once

namespace tunica::shell {

/// The whole program: reads the command line, does what it asks, returns the exit code.
int run_program(int argc, char** argv);

}  // namespace tunica::shell
