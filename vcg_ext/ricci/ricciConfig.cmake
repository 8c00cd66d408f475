# SPDX-License-Identifier: GPL-3.0-or-later
# find_package(ricci): the installed library, ricci::ricci.
include(CMakeFindDependencyMacro)
find_dependency(Eigen3 NO_MODULE)
find_dependency(Threads)
include("${CMAKE_CURRENT_LIST_DIR}/ricciTargets.cmake")
