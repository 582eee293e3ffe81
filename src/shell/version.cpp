// SPDX-License-Identifier: MIT
#include "shell/version.h"

#include <Eigen/Core>
#include <lua.hpp>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace tunica::shell {

namespace {
std::string eigen() { return fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION); }
}  // namespace

std::string versions_as_text() {
  return fmt::format("tunica {} ({}, Eigen {}, compiler {})", TUNICA_VERSION, LUAJIT_VERSION, eigen(), __VERSION__);
}

std::string versions_as_json() {
  return nlohmann::json{
      {"tunica", TUNICA_VERSION}, {"luajit", LUAJIT_VERSION}, {"eigen", eigen()}, {"compiler", __VERSION__}}
      .dump();
}

}  // namespace tunica::shell
