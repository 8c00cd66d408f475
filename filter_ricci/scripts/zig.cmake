# SPDX-License-Identifier: GPL-3.0-or-later
# Cross-compiles by zig, which brings the headers and libraries of every system along. Used by wheels.sh:
#   RICCI_ZIG         folder of the programs zig, zig-ar, zig-ranlib and zig-rc
#   RICCI_ZIG_TARGET  as zig names it, such as x86_64-linux-gnu.2.17
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES RICCI_ZIG RICCI_ZIG_TARGET)
if(NOT RICCI_ZIG_TARGET MATCHES "^([^-]+)-(linux|windows|macos)")
	message(FATAL_ERROR "RICCI_ZIG_TARGET is no target: ${RICCI_ZIG_TARGET}")
endif()
set(CMAKE_SYSTEM_PROCESSOR ${CMAKE_MATCH_1})
set(system_linux Linux)
set(system_windows Windows)
set(system_macos Darwin)
set(CMAKE_SYSTEM_NAME ${system_${CMAKE_MATCH_2}})
set(CMAKE_C_COMPILER "${RICCI_ZIG}/zig" cc -target ${RICCI_ZIG_TARGET})
set(CMAKE_CXX_COMPILER "${RICCI_ZIG}/zig" c++ -target ${RICCI_ZIG_TARGET})
set(CMAKE_AR "${RICCI_ZIG}/zig-ar")
set(CMAKE_RANLIB "${RICCI_ZIG}/zig-ranlib")
set(CMAKE_RC_COMPILER "${RICCI_ZIG}/zig-rc")
set(CMAKE_INSTALL_NAME_TOOL true) # nothing is installed
set(CMAKE_BUILD_WITH_INSTALL_NAME_DIR ON) # no library names the folder it was made in
set(CMAKE_INSTALL_NAME_DIR @rpath)
set(CMAKE_SHARED_LINKER_FLAGS_INIT -s)
if(RICCI_ZIG_TARGET MATCHES "musl") # whose threads have stacks of 128 KiB, all that Eigen may take for one array
	set(CMAKE_CXX_FLAGS_INIT -DEIGEN_STACK_ALLOCATION_LIMIT=16384)
elseif(RICCI_ZIG_TARGET MATCHES "macos") # whose loader exchanges what libraries have in common
	set(CMAKE_CXX_FLAGS_INIT "-fvisibility=hidden -fvisibility-inlines-hidden")
endif()
# Nothing of the machine that compiles, but for Eigen, which consists of headers.
set(CMAKE_FIND_ROOT_PATH "${CMAKE_CURRENT_LIST_DIR}/nothing")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
