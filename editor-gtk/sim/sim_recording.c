/* SPDX-License-Identifier: MIT
 *
 * sim_recording - the recording of a board as the source of a simulation: nothing is scanned,
 * and all of its scans can be shown.
 */
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/sim_mirror.h"

static void nothing(gpointer data)
{
	(void)data;
}

static void no_act(gpointer data, const struct act *acts, int count)
{
	(void)data;
	(void)acts;
	(void)count;
}

static const char *why_not(gpointer data, enum sim_wish wish)
{
	(void)data;
	return wish == SIM_WISH_RESTART ? NULL :
	       _("A recording only shows what has been. Choose “Edit”, then simulate");
}

static void refuse(GError **error, const char *path, const char *why)
{
	char *name = g_path_get_basename(path);

	g_set_error(error, G_IO_ERROR, G_IO_ERROR_FAILED, _("%s: %s"), name, why);
	g_free(name);
}

/* A device or another project would be read in vain. */
static struct record_file *open_file(const char *path, GError **error)
{
	struct record_file *file = NULL;
	GMappedFile *bytes = g_mapped_file_new(path, FALSE, error);
	struct diag diag = { .file = path };
	size_t where;
	char *text;

	if (!bytes)
		return NULL;
	file = record_file_open(g_mapped_file_get_contents(bytes),
				g_mapped_file_get_length(bytes), &diag.id, &where);
	g_mapped_file_unref(bytes);
	if (!file) {
		text = diag_said_whole(&diag);
		refuse(error, path, text);
		g_free(text);
	}
	return file;
}

/* The program of the document, as the image that was recorded. NULL: it is another one. */
static struct sim_program *find_program(LadderSim *sim, const struct record_file *file,
					const char *path, GError **error)
{
	struct sim_program *program = ladder_sim_build(sim, error);
	struct playback last;
	bool good;

	if (!program)
		return NULL;
	if (!playback_init(&last, file))
		g_error("out of memory");
	good = playback_seek(&last, record_file_last(file)) &&
	       sim_program_runs(program, last.twin.resource.image.program) &&
	       sim_program_open_image(program, last.twin.resource.image.program->base,
				      last.twin.resource.image.program->header->size);
	playback_free(&last);
	if (!good) {
		refuse(error, path, _("it was recorded with another program. Open that first"));
		g_clear_pointer(&program, sim_program_unref);
	}
	return program;
}

bool ladder_sim_play_recording(LadderSim *sim, const char *path, GError **error)
{
	struct sim_board board = { .act = no_act, .why_not = why_not, .wanted = nothing,
				   .past = nothing };
	const char *why = ladder_sim_why_not(sim, SIM_WISH_RESTART);
	struct record_file *file;
	bool good;

	if (why) {
		refuse(error, path, why);
		return false;
	}
	file = open_file(path, error);
	if (!file)
		return false;
	board.program = find_program(sim, file, path, error);
	if (!board.program) {
		record_file_free(file);
		return false;
	}
	board.name = record_file_board(file);
	board.period_ns = SIM_PERIOD;
	good = sim_mirror_play(ladder_sim_mirror_begin(sim, &board), file);
	sim_program_unref(board.program);
	if (!good)
		g_error("out of memory");
	return true;
}
