# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DCORE=vcg_ext/ricci -P tests/check_structure.cmake
# Checks what CONTRIBUTING.md says of the core's structure: no include points up the order of the
# folders; headers at the top are the public ones; no file is longer than 550 lines or defines more
# than 7 types, no folder holds more than a fifth of the code; no function has more than 6 parameters;
# no header of a stage names the options of the filters; the core names no host and uses no long
# double.
cmake_minimum_required(VERSION 3.25)

# A folder may include itself and the folders before it.
set(order
	base math surface metric flow curvature cut overlay layout finish measure fuchsian charts texture verify
	edge_swap pipeline)
# Public headers that every folder may include, and those that only the last one may.
set(leaves error.h options.h progress.h report.h)
set(entries parametrize.h sphere_map.h)
set(max_lines 550)
set(max_types 7)
set(max_parameters 6)
set(more_parameters
	charts/pack.cpp charts/separate_charts.cpp cut/shorten_cut.cpp cut/shorten_cut.h finish/finish.cpp finish/finish.h
	finish/least_distortion.cpp finish/least_distortion.h finish/repair.cpp finish/repair.h
	flow/flow_run.cpp flow/flow_run.h flow/ricci_flow.cpp flow/ricci_flow.h metric/conformal_flip.cpp
	metric/conformal_flip.h texture/carry_texture.cpp verify/holonomy_check.cpp verify/holonomy_check.h
	verify/metric_check.cpp verify/metric_check.h
	math/cholmod_blas.cpp) # BLAS
# The drivers choose by the options of the filters; the headers of the stages take what they need.
set(naming_options charts/pack.h edge_swap/swapped_flow.h)
set(host_words "MeshLab|PyMeshLab|meshlabserver|Qt[A-Z]|vcg::")

get_filename_component(CORE "${CORE}" ABSOLUTE)

# too_many(<text> <limit> <out>): the names of functions and lambdas with more parameters. Read is
# every list in brackets whose first entry is a type and a name or begins with const, which no call has.
# Templates' arguments, empty brackets and comments are no part of a list.
function(too_many text limit out)
	string(REGEX REPLACE "\"[^\"\n]*\"|//[^\n]*|[][]" "" text "${text}")
	foreach(depth RANGE 3) # as deep as arguments are nested
		string(REGEX REPLACE "<[^<>;(){}]*>|\\(\\)|{}" "" text "${text}")
	endforeach()
	set(first "[ \t\n]*(const |[A-Za-z_][A-Za-z0-9_:]*[.&*]* [A-Za-z_])[^,(){};]*")
	string(REPEAT ",[^,(){};]*" "${limit}" others)
	string(REGEX MATCHALL "[A-Za-z0-9_:~]*[ ]?\\(${first}${others}(,[^,(){};]*)*\\)" lists "${text}")
	set(names "")
	foreach(list IN LISTS lists)
		string(REGEX MATCH "^[A-Za-z0-9_:~]*" name "${list}")
		list(APPEND names "${name}")
	endforeach()
	set(${out} "${names}" PARENT_SCOPE)
endfunction()

set(failures 0)
macro(fail text)
	message(SEND_ERROR "${text}")
	math(EXPR failures "${failures} + 1")
endmacro()

file(GLOB_RECURSE files RELATIVE "${CORE}" "${CORE}/*.h" "${CORE}/*.cpp")
list(LENGTH files count)
if(count LESS 100)
	message(FATAL_ERROR "${CORE} holds ${count} files only: CORE is not the core's folder")
endif()
set(total 0)
foreach(folder IN LISTS order)
	set(lines_${folder} 0)
endforeach()
foreach(file IN LISTS files)
	file(READ "${CORE}/${file}" text)
	string(REGEX MATCHALL "\n" newlines "${text}")
	list(LENGTH newlines lines)
	math(EXPR total "${total} + ${lines}")
	if(lines GREATER max_lines)
		fail("${file}: ${lines} lines, more than ${max_lines}")
	endif()
	string(REGEX MATCH "${host_words}" word "${text}")
	if(word)
		fail("${file} speaks of a host: ${word}")
	endif()
	if(text MATCHES "\n[^/\n]*long double")
		fail("${file}: long double is not the same everywhere; DoubleDouble is")
	endif()
	too_many("${text}" ${max_parameters} functions)
	foreach(function IN LISTS functions)
		set(fault "${file}: ${function} has more than ${max_parameters} parameters")
		if(file IN_LIST more_parameters)
			message(STATUS "${fault}")
		else()
			fail("${fault}")
		endif()
	endforeach()
	get_filename_component(folder "${file}" DIRECTORY)
	string(REGEX MATCHALL "\n[ \t]*(struct|class|enum class|enum) [A-Za-z_][^(){};]*{" types "${text}")
	list(LENGTH types defined)
	if(defined GREATER max_types AND NOT file IN_LIST leaves)
		fail("${file} defines ${defined} types, more than ${max_types}")
	endif()
	if(file MATCHES "^[a-z_]+/.*\\.h$" AND NOT file MATCHES "^pipeline/"
			AND NOT file IN_LIST naming_options AND text MATCHES "[^A-Za-z](Hyperbolic)?Options[^A-Za-z]")
		fail("${file} names the options of the filters")
	endif()
	if(folder STREQUAL "")
		if(NOT file IN_LIST leaves AND NOT file IN_LIST entries)
			fail("${file} lies at the top, where only public headers are")
		endif()
	else()
		list(FIND order "${folder}" place)
		if(place LESS 0)
			fail("${file}: the folder ${folder} has no place in the order")
			continue()
		endif()
		math(EXPR lines_${folder} "${lines_${folder}} + ${lines}")
	endif()
	file(STRINGS "${CORE}/${file}" includes REGEX "^#include \"")
	foreach(line IN LISTS includes)
		string(REGEX REPLACE "^#include \"([^\"]+)\".*" "\\1" path "${line}")
		cmake_path(SET target NORMALIZE "${folder}/${path}")
		if(folder STREQUAL "")
			set(target "${path}")
		endif()
		if(NOT EXISTS "${CORE}/${target}")
			fail("${file} includes ${path}, which is not in the core")
			continue()
		endif()
		get_filename_component(into "${target}" DIRECTORY)
		if(folder STREQUAL "")
			continue()
		elseif(into STREQUAL "")
			if(target IN_LIST entries AND NOT folder STREQUAL "pipeline")
				fail("${file} includes ${target}, an entrance of the whole")
			endif()
			continue()
		endif()
		list(FIND order "${into}" other)
		if(other GREATER place)
			fail("${file} includes ${target}: ${into} comes after ${folder}")
		endif()
	endforeach()
endforeach()
foreach(folder IN LISTS order)
	math(EXPR share "100 * ${lines_${folder}} / ${total}")
	message(STATUS "${folder}: ${lines_${folder}} lines, ${share} %")
	if(share GREATER_EQUAL 20)
		fail("${folder} holds ${share} % of the core, a fifth or more")
	endif()
endforeach()
if(failures GREATER 0)
	message(FATAL_ERROR "${failures} faults of structure")
endif()
message(STATUS "${count} files, ${total} lines: structure as stated")
