/* SPDX-License-Identifier: GPL-3.0-or-later
 * Flattens a mesh by the library, and prints all outputs: a line each, with the name and every number in it.
 * print_map MESH [PARAMETER=VALUE...]; MESH is a text: numbers of vertices and faces, positions, corners. */
#include "ricci_c.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int fail(const char* what)
{
	fprintf(stderr, "%s\n", what);
	return 1;
}

static void print(const char* name, const ricci_array* array)
{
	int64_t count = 1, i;
	for (i = 0; i < array->dimensions; ++i)
		count *= array->shape[i];
	printf("%s", name);
	for (i = 0; i < count; ++i)
		switch (array->type) {
		case RICCI_BOOL:
		case RICCI_UINT8: printf(" %d", ((const uint8_t*) array->data)[i]); break;
		case RICCI_UINT16: printf(" %d", ((const uint16_t*) array->data)[i]); break;
		case RICCI_INT32: printf(" %" PRId32, ((const int32_t*) array->data)[i]); break;
		case RICCI_INT64: printf(" %" PRId64, ((const int64_t*) array->data)[i]); break;
		case RICCI_FLOAT32: printf(" %.9g", ((const float*) array->data)[i]); break;
		default: printf(" %.17g", ((const double*) array->data)[i]);
		}
	printf("\n");
}

static int read_mesh(ricci_run* run, const char* path)
{
	FILE* file = fopen(path, "r");
	int64_t vertices, faces, i;
	ricci_array v = {RICCI_FLOAT64, 2, {0, 3, 0}, NULL}, f = {RICCI_INT32, 2, {0, 3, 0}, NULL};
	double* positions;
	int32_t* corners;
	int read = 1, code;
	if (file == NULL || fscanf(file, "%" SCNd64 " %" SCNd64, &vertices, &faces) != 2)
		return -1;
	positions = (double*) malloc((size_t) vertices * 3 * sizeof *positions);
	corners = (int32_t*) malloc((size_t) faces * 3 * sizeof *corners);
	if (positions == NULL || corners == NULL)
		return -1;
	for (i = 0; i < 3 * vertices; ++i)
		read = read && fscanf(file, "%lf", &positions[i]) == 1;
	for (i = 0; i < 3 * faces; ++i)
		read = read && fscanf(file, "%" SCNd32, &corners[i]) == 1;
	fclose(file);
	v.shape[0] = vertices, v.data = positions;
	f.shape[0] = faces, f.data = corners;
	code = read ? ricci_set_array(run, "vertices", &v) || ricci_set_array(run, "faces", &f) : -1;
	free(positions);
	free(corners);
	return code;
}

int main(int count, char** arguments)
{
	ricci_run* run = ricci_create(RICCI_EUCLIDEAN);
	ricci_array array;
	const char* name;
	int i;
	if (count < 2 || run == NULL || read_mesh(run, arguments[1]) != 0)
		return fail("The mesh cannot be read.");
	for (i = 2; i < count; ++i) {
		char* value = strchr(arguments[i], '=');
		if (value == NULL)
			return fail("A parameter has no value.");
		*value++ = 0;
		if (ricci_set_parameter(run, arguments[i], value) != RICCI_OK)
			return fail(ricci_message(run));
	}
	if (ricci_execute(run) != RICCI_OK)
		return fail(ricci_message(run));
	printf("%s %s\n", ricci_library_version(), ricci_solver());
	for (i = 0; (name = ricci_output_name(run, i)) != NULL; ++i) {
		if (ricci_output(run, name, &array) != RICCI_OK)
			return fail(ricci_message(run));
		print(name, &array);
	}
	ricci_free(run);
	return 0;
}
