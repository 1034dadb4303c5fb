/* SPDX-License-Identifier: MIT
 *
 * iomap_scan - see iomap_scan.h. The BUS line goes to ladder-modbus in a map of its own, so that it is read with all
 * its options, also while the map is not saved.
 */
#include "editor-gtk/iomap/iomap_scan.h"

#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/kit/installed.h"

#include <glib/gstdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct iomap_scan {
	void (*changed)(gpointer data);
	gpointer data;
	GHashTable *units;       /* name of a bus, folded → GArray              */
	GSubprocess *program;    /* NULL: none runs                            */
	char *bus;               /* its name                                   */
	char *map;               /* the file that it reads                      */
	char *said;
	bool wrong;
};

struct iomap_scan *iomap_scan_new(void (*changed)(gpointer data), gpointer data)
{
	struct iomap_scan *scan = g_new0(struct iomap_scan, 1);

	scan->changed = changed;
	scan->data = data;
	scan->units = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, (GDestroyNotify)g_array_unref);
	return scan;
}

static void forget_file(struct iomap_scan *scan)
{
	if (scan->map)
		g_unlink(scan->map);
	g_clear_pointer(&scan->map, g_free);
}

void iomap_scan_stop(struct iomap_scan *scan)
{
	if (!scan->program)
		return;
	g_object_set_data(G_OBJECT(scan->program), "scan", NULL);
	g_subprocess_force_exit(scan->program);
	g_clear_object(&scan->program);
	forget_file(scan);
	g_clear_pointer(&scan->said, g_free);
}

void iomap_scan_free(struct iomap_scan *scan)
{
	if (!scan)
		return;
	iomap_scan_stop(scan);
	g_hash_table_unref(scan->units);
	g_free(scan->bus);
	g_free(scan->said);
	g_free(scan);
}

bool iomap_scan_runs(const struct iomap_scan *scan)
{
	return scan->program != NULL;
}

const char *iomap_scan_said(const struct iomap_scan *scan, bool *wrong)
{
	*wrong = scan->wrong;
	return scan->said;
}

void iomap_scan_hush(struct iomap_scan *scan)
{
	if (!scan->program)
		g_clear_pointer(&scan->said, g_free);
}

const GArray *iomap_scan_units(const struct iomap_scan *scan, const char *bus)
{
	char *folded = g_utf8_casefold(bus, -1);
	const GArray *units = g_hash_table_lookup(scan->units, folded);

	g_free(folded);
	return units;
}

/* @said: taken over. */
static void say(struct iomap_scan *scan, char *said, bool wrong)
{
	g_free(scan->said);
	scan->said = said;
	scan->wrong = wrong;
}

/* ---- the answer ---- */

/* A number behind "NAME": of one object of the answer. */
static double number_of(const char *object, const char *name)
{
	const char *at = strstr(object, name);

	return at ? g_ascii_strtod(at + strlen(name), NULL) : 0;
}

static GArray *read_units(const char *json)
{
	static const char start[] = "{\"unit\":";
	GArray *units = g_array_new(FALSE, FALSE, sizeof(struct iomap_unit));

	for (const char *at = strstr(json, start); at; at = strstr(at + 1, start)) {
		const struct iomap_unit unit = {
			.unit = (int)number_of(at, "\"unit\":"), .ms = number_of(at, "\"ms\":"),
			.exception = (int)number_of(at, "\"exception\":"),
		};

		g_array_append_val(units, unit);
	}
	return units;
}

/* Numbers at which something came that is no answer of a unit: "4, 9". Caller: g_free(). */
static char *doubts_of(const char *json)
{
	static const char start[] = "{\"at\":";
	GString *list = g_string_new(NULL);

	for (const char *at = strstr(json, start); at; at = strstr(at + 1, start))
		g_string_append_printf(list, "%s%d", list->len ? ", " : "", (int)number_of(at, start));
	return g_string_free(list, FALSE);
}

/* @told: what the program says besides, "": nothing. */
static char *found_text(const char *bus, const GArray *units, const char *json, const char *told)
{
	GString *list = g_string_new(NULL);
	char *doubts = doubts_of(json), *text, *more, *whole;

	for (guint i = 0; i < units->len; i++)
		g_string_append_printf(list, "%s%d", i ? ", " : "",
				       g_array_index(units, struct iomap_unit, i).unit);
	text = units->len ? g_strdup_printf(_("Units that answer on “%s”: %s"), bus, list->str) :
			    g_strdup_printf(_("No unit answers on “%s”. Check the power of the devices and the address; on a serial line also speed, parity and the two wires."), bus);
	more = *doubts ? g_strdup_printf(_("What comes for %s is damaged or of another unit: look for two devices with one number."), doubts) :
			 g_strdup(units->len ? told : "");
	whole = g_strdup_printf("%s%s%s", text, *more ? "  " : "", more);
	g_string_free(list, TRUE);
	g_free(doubts);
	g_free(text);
	g_free(more);
	return whole;
}

/* A scan that was stopped has let go of its program. */
static void ended(GObject *object, GAsyncResult *result, gpointer data)
{
	struct iomap_scan *scan = data;
	GSubprocess *program = G_SUBPROCESS(object);
	char *out = NULL, *err = NULL;
	GError *error = NULL;
	const bool good = g_subprocess_communicate_utf8_finish(program, result, &out, &err, &error);

	if (!g_object_get_data(object, "scan")) {
		/* the scan has gone, perhaps with its view */
	} else if (good && out && strstr(out, "\"units\"")) {
		GArray *units = read_units(out);

		say(scan, found_text(scan->bus, units, out, err ? g_strstrip(err) : ""), !units->len);
		g_hash_table_insert(scan->units, g_utf8_casefold(scan->bus, -1), units);
		g_clear_object(&scan->program);
		forget_file(scan);
		scan->changed(scan->data);
	} else {
		say(scan, g_strstrip(g_strdup(err && *err ? err : error ? error->message : "ladder-modbus")), true);
		g_clear_object(&scan->program);
		forget_file(scan);
		scan->changed(scan->data);
	}
	g_clear_error(&error);
	g_free(out);
	g_free(err);
}

/* ---- the program ---- */

static bool write_map(struct iomap_scan *scan, const struct io_text *io, int row)
{
	const struct io_row *line = &io->row[row];
	GString *text = g_string_new("BOARD \"scan\"\n");
	const int file = g_file_open_tmp("rungboard-scan-XXXXXX.io", &scan->map, NULL);
	bool good = file >= 0;

	g_string_append_len(text, io->text + line->from, (gssize)(line->words_end - line->from));
	g_string_append_c(text, '\n');
	if (good) {
		good = write(file, text->str, text->len) == (gssize)text->len;
		close(file);
	}
	g_string_free(text, TRUE);
	return good;
}

bool iomap_scan_begin(struct iomap_scan *scan, const struct io_text *io, int row)
{
	char *program = installed_program("ladder-modbus"), *name = io_text_field(io, row, IO_ADDRESS);
	GError *error = NULL;

	iomap_scan_stop(scan);
	g_free(scan->bus);
	scan->bus = g_strdup(name ? name : "");
	free(name);
	if (!program) {
		say(scan, g_strdup(_("ladder-modbus, which asks the units, was not found")), true);
		return false;
	}
	if (write_map(scan, io, row))
		scan->program = g_subprocess_new(G_SUBPROCESS_FLAGS_STDOUT_PIPE | G_SUBPROCESS_FLAGS_STDERR_PIPE, &error,
						 program, "scan", scan->bus, scan->map, "--json", NULL);
	g_free(program);
	if (!scan->program) {
		say(scan, g_strdup(error ? error->message : _("The map cannot be written for the scan")), true);
		g_clear_error(&error);
		forget_file(scan);
		return false;
	}
	say(scan, g_strdup_printf(_("Scanning “%s”: each unit from 1 to 247 is asked…"), scan->bus), false);
	g_object_set_data(G_OBJECT(scan->program), "scan", scan);
	g_subprocess_communicate_utf8_async(scan->program, NULL, NULL, ended, scan);
	return true;
}
