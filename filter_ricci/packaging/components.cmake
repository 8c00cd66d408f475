# SPDX-License-Identifier: GPL-3.0-or-later
# Read by CPack for each kind of package: the .deb goes into the system, archives are a host's folder.
if(CPACK_GENERATOR STREQUAL "DEB")
	set(CPACK_COMPONENTS_ALL system)
	set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
else()
	set(CPACK_COMPONENTS_ALL ${CPACK_RICCI_HOSTS})
	set(CPACK_PACKAGING_INSTALL_PREFIX /)
endif()
