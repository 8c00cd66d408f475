# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DBUILD_DIR=... -DUSE=arrays|vcglib|sources [-DVCGLIB_DIR=...] -DVERSION=... -DGENERATOR=... -DCOMPILER=... -P tests/use_library.cmake
# The library as others use it, from a project outside this one (vcg_ext/examples), without MeshLab or
# Qt. arrays, vcglib: the program of that name is built with the installed copy, with all warnings as
# errors, and run. sources: the folder is a part of the project, and brings no warnings along.
cmake_minimum_required(VERSION 3.25)

if(USE STREQUAL "vcglib" AND NOT VCGLIB_DIR)
	message("SKIPPED: vcglib was not found when the build was configured")
	return()
endif()

function(run out)
	execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE text ERROR_VARIABLE text RESULT_VARIABLE result)
	if(NOT result EQUAL 0)
		list(JOIN ARGN " " line)
		message(FATAL_ERROR "${line}\n${text}")
	endif()
	set(${out} "${text}" PARENT_SCOPE)
endfunction()

set(folder "${BUILD_DIR}/use_library/${USE}")
set(project "${CMAKE_CURRENT_LIST_DIR}/../vcg_ext/examples")
file(REMOVE_RECURSE "${folder}")
file(COPY "${project}/" DESTINATION "${folder}/project")
set(configure "${CMAKE_COMMAND}" -S "${folder}/project" -B "${folder}/build" -G "${GENERATOR}"
	"-DCMAKE_CXX_COMPILER=${COMPILER}" -DCMAKE_DISABLE_FIND_PACKAGE_Qt5=ON)

if(USE STREQUAL "sources")
	run(text ${configure} "-DRICCI_SOURCE_DIR=${project}/../ricci" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON)
	file(READ "${folder}/build/compile_commands.json" commands)
	string(JSON count LENGTH "${commands}")
	if(count LESS 90 OR commands MATCHES "Werror")
		message(FATAL_ERROR "${count} files, and warnings are errors in a project that did not ask for it")
	endif()
	message("${count} files are built without warnings of ours")
	return()
endif()

# The part alone, without a manifest for "uninstall".
run(text "${CMAKE_COMMAND}" --install "${BUILD_DIR}/vcg_ext/ricci" --prefix "${folder}/prefix")
if(NOT MSVC)
	list(APPEND configure "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wshadow -Wconversion -Werror")
endif()
file(WRITE "${folder}/version/CMakeLists.txt" "
	cmake_minimum_required(VERSION 3.25)
	project(version LANGUAGES CXX)
	find_package(ricci ${VERSION} EXACT REQUIRED)")
run(text "${CMAKE_COMMAND}" -S "${folder}/version" -B "${folder}/version/build" -G "${GENERATOR}"
	"-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_PREFIX_PATH=${folder}/prefix")
run(text ${configure} "-DCMAKE_PREFIX_PATH=${folder}/prefix" "-DVCGLIB_DIR=${VCGLIB_DIR}")
run(text "${CMAKE_COMMAND}" --build "${folder}/build" --target "flatten_${USE}" --config Release)
find_program(program "flatten_${USE}" PATHS "${folder}/build" "${folder}/build/Release" NO_DEFAULT_PATH REQUIRED)
run(text "${program}")
if(NOT text MATCHES "[1-9][0-9]* charts, (distortion 1|objective 4)\\.?[0-9]*\n$")
	message(FATAL_ERROR "${text}")
endif()
message("${text}")
