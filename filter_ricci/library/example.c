/* SPDX-License-Identifier: GPL-3.0-or-later
 * Flattens the surface of a cube, and prints its texture coordinates and some of the results. */
#include "ricci_c.h"

#include <stdio.h>

static int32_t show(void* context, double fraction, const char* text)
{
	int* lines = (int*) context;
	if (fraction < 0.0)
		printf("log %d: %s\n", ++*lines, text);
	return 1; /* go on */
}

int main(void)
{
	static const double positions[8][3] = {
		{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
	static const int32_t triangles[12][3] = {
		{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
		{2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
	const ricci_array vertices = {RICCI_FLOAT64, 2, {8, 3, 0}, positions};
	const ricci_array faces = {RICCI_INT32, 2, {12, 3, 0}, triangles};
	ricci_array uv, charts, objective;
	ricci_run* run;
	int lines = 0, f, k;

	if (ricci_c_version() != RICCI_C_VERSION) {
		fprintf(stderr, "The library has another interface than this program.\n");
		return 1;
	}
	run = ricci_create(RICCI_EUCLIDEAN);
	if (run == NULL) {
		fprintf(stderr, "There is not enough memory.\n");
		return 1;
	}
	if (ricci_set_array(run, "vertices", &vertices) != RICCI_OK ||
		ricci_set_array(run, "faces", &faces) != RICCI_OK ||
		ricci_set_parameter(run, "padding", "8") != RICCI_OK ||
		ricci_set_listener(run, show, &lines) != RICCI_OK || ricci_execute(run) != RICCI_OK ||
		ricci_output(run, "uv", &uv) != RICCI_OK ||
		ricci_output(run, "results.charts", &charts) != RICCI_OK ||
		ricci_output(run, "results.objective", &objective) != RICCI_OK) {
		fprintf(stderr, "%s\n", ricci_message(run));
		ricci_free(run);
		return 1;
	}
	for (f = 0; f < (int) uv.shape[0]; ++f)
		for (k = 0; k < 3; ++k) {
			const double* at = (const double*) uv.data + 2 * (3 * f + k);
			printf("face %d vertex %d: %g %g\n", f, (int) triangles[f][k], at[0], at[1]);
		}
	printf(
		"%d charts, objective %g\n",
		(int) *(const int32_t*) charts.data,
		*(const double*) objective.data);
	ricci_free(run);
	return 0;
}
