/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The filters as a library with a C interface: arrays in, arrays out, every parameter by its name.
 *
 *     ricci_run* run = ricci_create(RICCI_EUCLIDEAN);
 *     const ricci_array v = {RICCI_FLOAT64, 2, {vertices, 3, 0}, positions};
 *     const ricci_array f = {RICCI_INT32, 2, {faces, 3, 0}, triangles};
 *     if (ricci_set_array(run, "vertices", &v) || ricci_set_array(run, "faces", &f) ||
 *         ricci_set_parameter(run, "target_curvature", "Disk") || ricci_execute(run))
 *         puts(ricci_message(run));
 *     ricci_array uv;
 *     ricci_output(run, "uv", &uv);
 *     ricci_free(run);
 *
 * Threads: nothing is shared between runs. Any thread may use a run, one thread at a time, and several threads
 * may use a run each at the same time. The same inputs give the same bits, whatever else is running.
 *
 * Errors: no function throws, prints or aborts. Those that return int32_t return RICCI_OK or another ricci_code,
 * and ricci_message() then has one or more sentences that say what is wrong and what to do. A null pointer in
 * place of a run is RICCI_MISUSE, or no answer from the other functions.
 *
 * Texts are UTF-8 and end with a zero byte.
 */
#ifndef RICCI_C_H
#define RICCI_C_H

#include <stdint.h>

#if !defined(_WIN32)
#define RICCI_API __attribute__((visibility("default")))
#elif defined(RICCI_C_BUILD)
#define RICCI_API __declspec(dllexport)
#else
#define RICCI_API __declspec(dllimport)
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Grows when a program that was compiled for an earlier one no longer fits. Names of inputs, outputs and
 * parameters may be added without that. */
#define RICCI_C_VERSION 1

/* The filters, in the order of ricci_description(). */
enum ricci_filter {
	RICCI_EUCLIDEAN = 0, /* conformal maps to the plane */
	RICCI_HYPERBOLIC = 1 /* hyperbolic metrics, drawn in the Poincare disk */
};

enum ricci_code {
	RICCI_OK = 0,
	RICCI_REFUSED = 1,   /* the mesh, a value or a file cannot be used, or has no such map */
	RICCI_CANCELLED = 2, /* by the listener */
	RICCI_TIMED_OUT = 3, /* the parameter time_limit */
	RICCI_NO_MEMORY = 4,
	RICCI_MISUSE =
		5, /* a call that this header does not allow: a name, type or shape that is not there */
	RICCI_FAILED = 6 /* a defect of the library: please report it */
};

/* What an array holds, in the byte order of the machine. */
enum ricci_type {
	RICCI_BOOL = 0, /* one byte: 0, or anything else for true; outputs have 0 and 1 */
	RICCI_UINT8 = 1,
	RICCI_UINT16 = 2,
	RICCI_INT32 = 3,
	RICCI_INT64 = 4,
	RICCI_FLOAT32 = 5,
	RICCI_FLOAT64 = 6
};

/* An array in rows, the last index running fastest, without gaps. */
typedef struct ricci_array
{
	int32_t type;       /* ricci_type */
	int32_t dimensions; /* 0 to 3; 0 is one number */
	int64_t shape[3];   /* [dimension] entries behind dimensions are not read, and 0 in outputs */
	const void* data;   /* may be null if there are no entries */
} ricci_array;

/* One run of a filter: its inputs, then its outputs. */
typedef struct ricci_run ricci_run;

/* RICCI_C_VERSION as the library was compiled. A program checks that it is its own. */
RICCI_API int32_t ricci_c_version(void);

/* Version of the library, such as "3.0.0". Lives as long as the library. */
RICCI_API const char* ricci_library_version(void);

/* "CHOLMOD" or "Eigen": the solver of sparse equations inside. Lives as long as the library. */
RICCI_API const char* ricci_solver(void);

/* Both filters in JSON, a list of objects:
 *     name, python_name, info (HTML); renamed, an object: old names of parameters, and what is in their place; and
 *     parameters, a list of objects in the order of the dialogs:
 *         name, label, tooltip (HTML), place in MeshLab's dialog (shown, advanced or options), default, and
 *         type: "enum" (with choices, a list; default is one of them), "bool", "int", "float" or "file" (a path,
 *             with files, the pattern of a file dialog; default "").
 * Lives as long as the library. Null if there was no memory for it. */
RICCI_API const char* ricci_description(void);

/* A run with default parameters and without a mesh.
 * filter: a ricci_filter
 * Returns null if there is no such filter or no memory. The caller gives it back by ricci_free(). */
RICCI_API ricci_run* ricci_create(int32_t filter);

/* Ends a run and all that it gave out. Null is allowed. Not from inside its listener. */
RICCI_API void ricci_free(ricci_run* run);

/* Sets a parameter of the filter.
 * value: of a choice its name, in any case, or its number; of a truth value true, false, 1 or 0; a number as in C
 *     or JSON, whatever the locale; of a file its path, which starts from the folder (ricci_set_text()) if it is
 *     relative.
 * Values that are not such a text, and names that are not parameters, are RICCI_MISUSE. Whether a number can be used is
 * only known to ricci_execute(). */
RICCI_API int32_t ricci_set_parameter(ricci_run* run, const char* name, const char* value);

/* Sets an array of the mesh; it is copied. Null in place of the array takes an earlier one back. With V vertices
 * and F faces:
 *     vertices           V x 3      positions, needed
 *     faces              F x 3      the vertices of each triangle, counted from 0, needed
 *     faux               F x 3      true: the side from this corner to the next one lies inside a polygon
 *     selected_vertices  V          true: a cone, or a corner of the rectangle, where the target asks for them
 *     selected_edges     F x 3      true: the side is a seam, if the parameter seams says so; one of the two faces
 *                                   of an edge is enough
 *     selected_faces     F          true: seams run round these, if the parameter seams says so
 *     quality            V          target curvature in radians, if target_curvature says so
 *     part               V          any number: vertices of different parts are never joined, such as those of
 *                                   several meshes
 *     uv                 F x 3 x 2  old texture coordinates of the corners, for the parameters seams and
 *                                   carry_texture; v grows upwards
 *     picture_of_face    F          the picture that the face shows, counted from 0 in the order of
 *                                   ricci_add_picture(); any other number: none. Without it: the first one
 *     vertex_colors      V x 4      red, green, blue, alpha, 0 to 255: for carry_texture, where there is no
 *     face_colors        F x 4      picture; those of vertices come first
 *     matrix             4 x 4      the mesh is flattened as this moves it (column vectors); the outputs are not
 *                                   moved
 * Any type is converted; indices and truth values must be of BOOL or an integer type. RICCI_MISUSE if there is no
 * such name, type or shape. Lengths that do not fit to each other are RICCI_MISUSE of ricci_execute(); corners that
 * are not vertices are RICCI_REFUSED there. */
RICCI_API int32_t ricci_set_array(ricci_run* run, const char* name, const ricci_array* array);

/* Sets a text about the mesh; it is copied.
 *     name    of the mesh, for the report
 *     folder  from which relative paths start; without it the process's current one */
RICCI_API int32_t ricci_set_text(ricci_run* run, const char* name, const char* text);

/* Adds a picture that the old texture coordinates refer to; it is copied.
 * name: by which sentences call it; the new picture may not have this name
 * picture: height x width x channels of UINT8 or UINT16, the topmost row first; 1 grey, 2 grey and alpha, 3 RGB,
 *     4 RGB and alpha (not multiplied into the colours). Null stands for one that could not be loaded: runs that
 *     need it are refused. */
RICCI_API int32_t ricci_add_picture(ricci_run* run, const char* name, const ricci_array* picture);

/* Called by ricci_execute(), in the thread that called it.
 * context: as given to ricci_set_listener()
 * fraction: the share of the work that is done, 0 to 1, many times a second; -1: text is a line for the log; -2: text
 *     is one of those lines, once more, at the end of the run: a doubt about the map that was made
 * text: what is being done, or a line without a line end; valid during the call only
 * Returns other than 0 to go on, 0 to cancel. Of lines the answer is not read. It must return: no exception, no
 * longjmp. It may not use the run. */
typedef int32_t (*ricci_listener)(void* context, double fraction, const char* text);

/* Sets the listener; null: none. */
RICCI_API int32_t ricci_set_listener(ricci_run* run, ricci_listener listener, void* context);

/* Runs the filter on the inputs, which stay as they are: it may be called again, also with other parameters. Reports
 * are written as the parameter report says. The picture of carry_texture is drawn, its path is checked, but the
 * file is the caller's to write. A failure leaves no outputs, and no files unless memory runs out at the very end. */
RICCI_API int32_t ricci_execute(ricci_run* run);

/* What the last call with this run found wrong, ricci_output() apart; "" after RICCI_OK. Valid until the next call
 * with it. */
RICCI_API const char* ricci_message(const ricci_run* run);

/* The number of outputs; 0 before ricci_execute() has returned RICCI_OK. */
RICCI_API int64_t ricci_output_count(const ricci_run* run);

/* The name of the output with this number, counted from 0; null beyond the last. Valid until the next
 * ricci_execute() or ricci_free(). */
RICCI_API const char* ricci_output_name(const ricci_run* run, int64_t number);

/* Gives the output with this name, or RICCI_MISUSE if there is none. The data belong to the run, until the next
 * ricci_execute() or ricci_free(). V and F are those of the inputs, and larger for the output triangulation 'Common
 * refinement': first come the vertices of the input, and the first piece of each of its faces.
 *     vertices           V x 3      FLOAT64
 *     faces              F x 3      INT32
 *     face_of_origin     F          INT32    of the input
 *     faux               F x 3      BOOL     if the input has it
 *     uv                 F x 3 x 2  FLOAT64  texture coordinates of the corners, rounded to floats
 *     chart              F          INT32    the chart of the face; -1: it has no area in the plane and no chart
 *     quality            V          FLOAT64  quasi-conformal distortion, 1: angles are kept
 *     log_radius         V          FLOAT64  logarithms of the radii of the flow's circles, up to a constant
 *     target_curvature   V          FLOAT64  radians
 *     vertex_colors      V x 4      UINT8    if the input has them or the parameter colorize is true
 *     face_colors        F x 4      UINT8    if the input has them; white where the picture shows them
 *     picture            height x width x channels, 3 or 4, of UINT8 or UINT16, as for ricci_add_picture(): with
 *                                   carry_texture
 *     results.KEY        BOOL, INT32 or FLOAT64, one number or a row of them: the results in the order of the report
 *     LAYER.vertices, LAYER.faces, LAYER.edges (E x 2, INT32), LAYER.quality, LAYER.colors (V x 4), LAYER.uv, and
 *     LAYER.matrix (4 x 4, which shows the layer beside the mesh): layers that parameters ask for, each with what it
 *                                   has. LAYER is flat, sphere, disk, cover, axes or polygon. */
RICCI_API int32_t ricci_output(const ricci_run* run, const char* name, ricci_array* output);

#ifdef __cplusplus
}
#endif

#endif
