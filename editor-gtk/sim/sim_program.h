/* SPDX-License-Identifier: MIT
 *
 * sim_program - a project that was built to be simulated; its places and faults in words.
 */
#ifndef EDITOR_SIM_PROGRAM_H
#define EDITOR_SIM_PROGRAM_H

#include "editor-gtk/sim/sim.h"

/* Counted: the thread and the window release it at different times. */
struct sim_program {
	gatomicrefcount count;
	struct ladder *ladder;
	const struct program *program;
	char *text;              /* its source                                 */
	char *form;              /* the same as the document writes it, if that differs; or NULL */
	guint8 *image;           /* of a board, which `program` reads; else NULL */
	struct program opened;   /* of it                                      */
	guint8 *safe;            /* for twin_set_safe(), from the I/O map beside it */
	struct io_said *said;    /* what tells the quality of inputs, of that map */
	int said_count;
};
/** sim_program_say_why - sets @error to the first error of @diags, with its place in @project;
 * NULL: in the text. */
void sim_program_say_why(const struct project *project, const struct diag_list *diags,
			 GError **error);
/** sim_program_new - @file: interned, for diagnostics and to find the I/O map beside it; "-":
 * no file. Owns: sim_program_unref(). Any thread. Fails: NULL, and @error is the first error. */
struct sim_program *sim_program_new(const char *file, const char *text, gsize len,
				    GError **error);
/** sim_program_read - the same by @reader, which is taken over: of ladder_document_reader(). */
struct sim_program *sim_program_read(struct ladder *reader, const char *file, const char *text,
				     gsize len, GError **error);
/** sim_program_read_listed - the same with results beside the lists that ladders and charts become:
 * ladder_watch_lists(). No board runs it. A program that is too large with them has none. */
struct sim_program *sim_program_read_listed(struct ladder *reader, const char *file,
					    const char *text, gsize len, GError **error);
/** sim_program_open_image - from now on the program is the image that a board runs, instead of
 * the translation of the same sources: places are those of the board. Fails: false: @bytes is
 * no image; nothing has changed. */
bool sim_program_open_image(struct sim_program *program, const void *bytes, gsize len);
/** sim_program_runs - whether @image is this program: same code and layout of data. */
bool sim_program_runs(const struct sim_program *program, const struct program *image);
struct sim_program *sim_program_ref(struct sim_program *program);
void sim_program_unref(struct sim_program *program);
/** sim_program_set_form - takes @form: the text in the form of the document. Of the window only. */
void sim_program_set_form(struct sim_program *program, char *form);
/** sim_program_is_same - same code, values of the I/O map and text, in the form of the document; the VIEW parts may
 * differ. */
bool sim_program_is_same(const struct sim_program *a, const struct sim_program *b);

/** sim_place_words - a place in the program, as the sheet shows it. Caller frees. */
char *sim_place_words(const struct sim_program *program, const struct fault_place *at);
/** sim_fault_words - "instruction budget exceeded: Main, rung 2, row 1, column C". Caller
 * frees. */
char *sim_fault_words(const struct sim_program *program, const struct resource *resource);

#endif
