/* SPDX-License-Identifier: MIT
 *
 * test_beside - the scenarios and I/O maps in a folder that belong to a program, and the
 * safe outputs of its map.
 */
#include "editor-gtk/document/side_file.h"
#include "editor-gtk/document/iomap_beside.h"
#include "tests/tap.h"

#include <glib/gstdio.h>
#include <string.h>

static char *folder;

static void make(const char *name)
{
	char *path = g_build_filename(folder, name, NULL);
	char *parent = g_path_get_dirname(path);

	g_mkdir_with_parents(parent, 0700);
	CHECK(g_file_set_contents(path, "", 0, NULL));
	g_free(parent);
	g_free(path);
}

/* Compares their names, joined. */
static bool are(const char *program, const char *ending, bool own, const char *wanted)
{
	char *path = g_build_filename(folder, program, NULL);
	GPtrArray *files = side_file_list(path, ending, own);
	GString *got = g_string_new(NULL);
	bool same;

	for (guint i = 0; i < files->len; i++)
		g_string_append_printf(got, "%s%s", i ? " " : "",
				       (char *)files->pdata[i] + strlen(folder) + 1);
	same = strcmp(got->str, wanted) == 0;
	if (!same)
		printf("# %s, not %s\n", got->str, wanted);
	g_string_free(got, TRUE);
	g_ptr_array_unref(files);
	g_free(path);
	return same;
}

static bool map_is(const char *program, const char *wanted)
{
	char *path = g_build_filename(folder, program, NULL), *map = iomap_beside(path);
	const bool same = wanted ? map && strcmp(map + strlen(folder) + 1, wanted) == 0 :
				   !map;

	if (!same)
		printf("# %s, not %s\n", map ? map : "none", wanted ? wanted : "none");
	g_free(map);
	g_free(path);
	return same;
}

static bool is_own(const char *program, const char *name)
{
	char *path = g_build_filename(folder, program, NULL);
	char *map = g_build_filename(folder, name, NULL);
	const bool own = iomap_is_own(path, map);

	g_free(map);
	g_free(path);
	return own;
}

static void test_own(void)
{
	CHECK(is_own("pump.rung", "pump.io") && is_own("pump.rung", "pump-lab.io"));
	CHECK(!is_own("pump.rung", "pump-two.io") && !is_own("pump.rung", "other.io"));
	CHECK(!is_own("pump.rung", "boards/pi.io") && !is_own("new.rung", "other.io"));
	CHECK(!iomap_is_own(NULL, "pump.io"));
}

/* The first two bytes of safe outputs under pump.io with this text; -1: NULL. */
static int safe_of(const char *text)
{
	struct areas areas;
	char *map = g_build_filename(folder, "pump.io", NULL);
	char *program = g_build_filename(folder, "pump.rung", NULL);
	struct iomap_at_rest rest;
	guint8 *safe;
	int got;

	areas_init(&areas);
	CHECK(g_file_set_contents(map, text, -1, NULL));
	rest = iomap_read_beside(program, &areas);
	safe = rest.safe;
	got = safe ? safe[0] | safe[1] << 8 | safe[areas.bytes[AREA_Q]] << 16 : -1;
	g_free(rest.safe);
	g_free(rest.said);
	g_free(map);
	g_free(program);
	return got;
}

static void test_safe(void)
{
	CHECK(map_is("pump.rung", "pump.io") && map_is("pump-two.rung", "pump-two.io"));
	CHECK(map_is("new.rung", NULL) && iomap_beside(NULL) == NULL);
	CHECK(safe_of("") == -1);
	CHECK(safe_of("BOARD \"Desk\"\n%IX0.0 sim\n%QX0.0 sim safe=0\n%QX0.7 sim\n") == -1);
	CHECK(safe_of("BOARD \"Desk\"\n%QX0.0 sim safe=0\n%QX0.6 sim safe=1\n"
		      "%QX1.1 sim safe=1 active-low\n") == 0x0240);
	CHECK_AS(safe_of("BOARD \"Desk\"\n%QX0.0 sim safe=hold\n%QX0.6 sim safe=1\n") == 0x010040,
		 "an output that holds is in the second half");
	CHECK_AS(safe_of("BOARD \"Desk\"\n%QW0 sim safe=513\n") == 0x0201, "a word has its safe number");
	CHECK_AS(safe_of("BOARD \"Desk\"\n%AQW0 sim safe=1\n%AQW30 sim safe=hold\n") == -1,
		 "a value of another area is no bit of Q");
	CHECK(safe_of("BOARD \"Desk\"\n%QB0 sim safe=hold\n") == 0xff0000);
	/* one bad line: ladderd refuses the map */
	CHECK(safe_of("BOARD \"Desk\"\n%QX0.6 sim safe=1\n%QX0.7 nothing\n") == -1);
	CHECK(safe_of("BOARD \"Desk\"\n%QX0.6 sim safe=1\n%QX600.7 sim safe=1\n") == -1);
}

int main(void)
{
	static const char *const names[] = {
		"pump.rung", "pump-two.rung", "pump.io", "pump-lab.io", "pump-two.io",
		"pump-two-lab.io", "pumps.io", "other.io", "boards/pi.io", "pump.scn",
		"pumps.scn", "pump-two.scn",
	};
	GPtrArray *none;

	folder = g_dir_make_tmp("rungboard-beside-XXXXXX", NULL);
	for (gsize i = 0; i < G_N_ELEMENTS(names); i++)
		make(names[i]);
	CHECK(are("pump.rung", ".io", true, "pump-lab.io pump.io"));
	CHECK(are("pump.rung", ".io", false,
		  "boards/pi.io other.io pump-two-lab.io pump-two.io pumps.io"));
	CHECK(are("pump-two.rung", ".io", true, "pump-two-lab.io pump-two.io"));
	CHECK(are("pump.rung", ".scn", true, "pump.scn"));
	CHECK(are("pump-two.rung", ".scn", true, "pump-two.scn"));
	CHECK(are("new.rung", ".io", true, ""));
	none = side_file_list(NULL, ".io", true);
	CHECK(none->len == 0);
	g_ptr_array_unref(none);
	test_own();
	test_safe();
	for (gsize i = G_N_ELEMENTS(names); i-- > 0;) {
		char *path = g_build_filename(folder, names[i], NULL);

		g_remove(path);
		g_free(path);
	}
	char *boards = g_build_filename(folder, "boards", NULL);
	g_rmdir(boards);
	g_rmdir(folder);
	g_free(boards);
	g_free(folder);
	return tap_done();
}
