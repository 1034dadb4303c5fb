/* SPDX-License-Identifier: MIT
 *
 * classic - opens and writes projects of ClassicLadder.
 *
 * It writes a copy, loaded from the document's text; the document does not change.
 */
#include "editor-gtk/document/classic.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/report_lines.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/exchange/report.h"

#include <stdlib.h>

/* ---- by its name ---- */

static const struct { const char *ending; enum classic_dialect dialect; gboolean packed; }
kinds[] = {
	{ ".clprj", CLASSIC_UPSTREAM, FALSE }, { ".clprjz", CLASSIC_UPSTREAM, TRUE },
	{ ".clp", CLASSIC_LINUXCNC, FALSE }, { ".txt", CLASSIC_NUMERIC, FALSE },
};

static int kind_of(const char *path)
{
	char *lower = g_ascii_strdown(path, -1);
	int kind = -1;

	for (guint i = 0; i < G_N_ELEMENTS(kinds); i++)
		if (g_str_has_suffix(lower, kinds[i].ending))
			kind = (int)i;
	g_free(lower);
	return kind;
}

gboolean classic_save_is(const char *path)
{
	const int kind = kind_of(path);

	return kind >= 0 && kinds[kind].dialect != CLASSIC_NUMERIC;
}

/* ---- reports ---- */

static void add_line(GPtrArray *lines, bool refused, const char *pou, int rung, int row,
		     int col, char *text)
{
	struct left_line *line = g_new(struct left_line, 1);

	*line = (struct left_line){ refused, g_strdup(pou), text, rung, row, col };
	g_ptr_array_add(lines, line);
}

static void add_diags(GPtrArray *lines, const struct diag_list *diags)
{
	for (int i = 0; i < diags->count; i++) {
		const struct diag *diag = &diags->diag[i];

		if (diag_severity(diag->id) == SEVERITY_ERROR)
			add_line(lines, true, diag->pou, diag->rung, diag->row, diag->col,
				 diag_said_whole(diag));
	}
}

static void add_changes(GPtrArray *lines, const struct classic_report *report)
{
	for (int i = 0; i < report->count; i++)
		add_line(lines, false, report->line[i].pou, report->line[i].rung, 0, 0,
			 g_strdup(report->line[i].text));
}

/* ---- the text ---- */

static char *export_loaded(struct ladder *ladder, enum classic_dialect dialect, size_t *len,
			   GPtrArray *lines)
{
	struct diag_list *diags = g_new(struct diag_list, 1);
	struct classic_report report;
	char *text;

	diag_init(diags);
	report_init(&report);
	report.translate = said;
	text = ladder_export_classic(ladder, dialect, NULL, len, &report, diags);
	add_diags(lines, diags);
	if (text)
		add_changes(lines, &report);
	report_free(&report);
	g_free(diags);
	return text;
}

/* A chart that ClassicLadder cannot hold is exported as a ladder. */
static char *export_ladders(struct ladder *ladder, enum classic_dialect dialect,
			    size_t *len, GPtrArray *lines)
{
	struct diag_list *diags = g_new(struct diag_list, 1);
	struct ladder *again = ladder_new();
	char *text, *out = NULL;
	size_t text_len;

	diag_init(diags);
	text = ladder_export_ladder(ladder, &text_len, diags);
	add_diags(lines, diags);
	if (text && again) {
		if (ladder_load_text(again, "", text, text_len) && ladder_build(again))
			out = export_loaded(again, dialect, len, lines);
		else
			add_diags(lines, ladder_diags(again));
	}
	free(text);
	ladder_free(again);
	g_free(diags);
	return out;
}

static char *export_copy(LadderDocument *document, enum classic_dialect dialect,
			 size_t *len, GPtrArray *lines)
{
	struct ladder *ladder = ladder_document_reader(document);
	char *text, *out = NULL;
	gsize text_len;

	text = ladder_document_text(document, &text_len);
	if (!ladder_load_text(ladder, ladder_document_file(document), text, text_len) ||
	    !ladder_build(ladder))
		add_diags(lines, ladder_diags(ladder));
	else if (ladder_sfc_fits_classic(ladder))
		out = export_loaded(ladder, dialect, len, lines);
	else
		out = export_ladders(ladder, dialect, len, lines);
	g_free(text);
	ladder_free(ladder);
	return out;
}

/* ---- the file ---- */

/* Compresses as gzip does. Caller frees. */
static char *packed(const char *text, gsize len, gsize *out_len, GError **error)
{
	GOutputStream *memory = g_memory_output_stream_new_resizable();
	GZlibCompressor *zip = g_zlib_compressor_new(G_ZLIB_COMPRESSOR_FORMAT_GZIP, 9);
	GOutputStream *out = g_converter_output_stream_new(memory, G_CONVERTER(zip));
	char *bytes = NULL;

	if (g_output_stream_write_all(out, text, len, NULL, NULL, error) &&
	    g_output_stream_close(out, NULL, error)) {
		*out_len = g_memory_output_stream_get_data_size(
			G_MEMORY_OUTPUT_STREAM(memory));
		bytes = g_memory_output_stream_steal_data(G_MEMORY_OUTPUT_STREAM(memory));
	}
	g_object_unref(out);
	g_object_unref(zip);
	g_object_unref(memory);
	return bytes;
}

static gboolean write_file(const char *path, const char *text, gsize len, gboolean pack,
			   GError **error)
{
	char *bytes = pack ? packed(text, len, &len, error) : NULL;
	const gboolean good = (bytes || !pack) &&
		disk_save(path, bytes ? bytes : text, len, error);

	g_free(bytes);
	return good;
}

/* Reports that `ladder export --io` exports the lines of the I/O map; the editor does not. */
static void tell_map(LadderDocument *document, GPtrArray *lines)
{
	const char *path = ladder_document_path(document);
	const char *dot = path ? strrchr(path, '.') : NULL;
	char *map = dot ? g_strdup_printf("%.*s.io", (int)(dot - path), path) : NULL;

	if (map && g_file_test(map, G_FILE_TEST_EXISTS)) {
		char *name = g_path_get_basename(map);

		add_line(lines, false, NULL, 0, 0, 0, g_strdup_printf(
			 _("the I/O map “%s” was not exported: ladder export --io includes it"),
			 name));
		g_free(name);
	}
	g_free(map);
}

gboolean classic_save(LadderDocument *document, const char *path, GPtrArray *lines,
		      GError **error)
{
	const int kind = kind_of(path);
	gboolean good;
	size_t len;
	char *text;

	if (kind < 0) {
		g_set_error(error, G_FILE_ERROR, G_FILE_ERROR_INVAL,
			    _("%s: the name must end in .clprj, .clprjz, .clp or .txt"),
			    path);
		return FALSE;
	}
	text = export_copy(document, kinds[kind].dialect, &len, lines);
	if (!text) {
		g_set_error(error, G_FILE_ERROR, G_FILE_ERROR_INVAL,
			    _("ClassicLadder cannot hold this project; nothing was "
			      "written."));
		return FALSE;
	}
	good = write_file(path, text, len, kinds[kind].packed, error);
	if (good)
		tell_map(document, lines);
	free(text);
	return good;
}

/* ---- opening ---- */

gboolean classic_is_project(const char *path)
{
	return ladder_import_format(path) != NULL;
}

static void fail(struct ladder *ladder, const char *path, GError **error)
{
	const struct diag *diag = diag_first_error(ladder_diags(ladder));
	char *line = diag ? diag_said_line(diag) : NULL;

	g_set_error(error, G_FILE_ERROR, G_FILE_ERROR_INVAL, "%s", line ? line : path);
	g_free(line);
}

char *classic_import(const char *path, gsize *len, struct ladder **from, GError **error)
{
	struct ladder *ladder = ladder_new();
	char *text = NULL, *copy;

	*from = NULL;
	if (!ladder || !ladder_take_classic(ladder, false) || !ladder_take_others(ladder))
		g_error("out of memory");
	ladder_classic_task(ladder, true);
	ladder_import_language(ladder, said);
	if (ladder_load(ladder, path) && ladder_import_report(ladder))
		text = ladder_write(ladder, len);
	else
		fail(ladder, path, error);
	copy = text ? g_memdup2(text, *len + 1) : NULL;
	free(text);
	if (copy)
		*from = ladder;
	else
		ladder_free(ladder);
	return copy;
}
