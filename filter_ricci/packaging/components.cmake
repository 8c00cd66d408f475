# SPDX-License-Identifier: GPL-3.0-or-later
# Read by CPack for each kind of package: the .deb goes into the system, archives are a host's folder.
if(CPACK_GENERATOR STREQUAL "DEB")
	set(CPACK_COMPONENTS_ALL system)
	set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
else()
	set(CPACK_COMPONENTS_ALL ${CPACK_RICCI_HOSTS})
	set(CPACK_PACKAGING_INSTALL_PREFIX /)
endif()

# The time in archives and packages, so that two builds of one commit give the same bytes; outside a
# repository, when the sources' list of changes was last written.
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
	execute_process(COMMAND git -C "${CPACK_RICCI_SOURCE_DIR}" log -1 --format=%ct
		OUTPUT_VARIABLE time OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
	if(NOT time)
		file(TIMESTAMP "${CPACK_RICCI_SOURCE_DIR}/CHANGELOG.md" time "%s" UTC)
	endif()
	set(ENV{SOURCE_DATE_EPOCH} "${time}")
endif()
