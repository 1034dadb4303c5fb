/* SPDX-License-Identifier: MIT
 *
 * test_render - `ladder-editor --render`, in this process and without a display.
 *
 * Pages of paper: test_pages.c.
 */
#include "tests/editor/drawn.h"
#include "tests/editor/rendered.h"

#include <signal.h>
#include <sys/resource.h>

#define FULL_BYTES 500          /* larger than a message, smaller than a picture */
#define OLD "what was there"
#define HUGE_BYTES ((off_t)1 << 40)

static void check_svg(void)
{
	CHECK(render(SHAPES " -o OUT/a.svg") == 0);
	CHECK_TEXT(said, "");
	CHECK(has("a.svg", ">Motor</text>"));
	CHECK(has("a.svg", ">启动</text>"));
	CHECK(has("a.svg", "SUBROUTINE Sub"));
	CHECK(has("a.svg", "Level * 3 &gt; Count"));
	CHECK(render(SHAPES " -o OUT/b.svg") == 0 && same("a.svg", "b.svg"));
	CHECK(render(SHAPES " --dark -o OUT/dark.svg") == 0 && has("dark.svg", "#1b1c1f"));
	CHECK(render(SHAPES " --rung 1 -o OUT/one.svg") == 0 && !has("one.svg", "CTU"));
	CHECK(render(SHAPES " --pou SUB -o OUT/sub.svg") == 0 && has("sub.svg", "STOP") &&
	      !has("sub.svg", "Motor"));
	CHECK(render(SHAPES " --show addresses -o OUT/c.svg --rung 1") == 0 &&
	      !has("c.svg", "启动") && has("c.svg", "%IX0.0"));
	CHECK(render("ladders/mixer.rung -o OUT/il.svg") == 0 && has("il.svg", "JMPCN"));
	/* Types of the project are named in a program that is drawn. */
	CHECK(render("ladders/roadworks.rung -o OUT/st.svg") == 0 && has("st.svg", "Phase"));
}

static void check_png(void)
{
	cairo_surface_t *surface;
	char *path = in_folder("a.png");

	CHECK(render(SHAPES " --scale 2 --rung 1 --width 700 -o OUT/a.png") == 0);
	surface = cairo_image_surface_create_from_png(path);
	CHECK(cairo_image_surface_get_width(surface) >= 2 * (700 + RUNG_LEFT + RUNG_AFTER));
	const unsigned char *pixel = cairo_image_surface_get_data(surface);
	CHECK(pixel && pixel[4 * (cairo_image_surface_get_width(surface) - 2)] == 0xff);
	cairo_surface_destroy(surface);
	g_free(path);
}

static void check_diff(void)
{
	char *path = in_folder("new.rung"), *text = NULL, **parts, *changed;

	g_file_get_contents(SHAPES, &text, NULL, NULL);
	parts = g_strsplit(text, "| NC Stop (* interlock *) |", 2);
	changed = g_strjoinv("| NO Stop (* interlock *) |", parts);
	g_file_set_contents(path, changed, -1, NULL);
	CHECK(render("--diff " SHAPES " OUT/new.rung -o OUT/diff.svg") == 0);
	CHECK(has("diff.svg", ">+</text>") && has("diff.svg", ">\xe2\x88\x92</text>"));
	CHECK(has("diff.svg", ">\xe2\x89\xa0</text>"));
	CHECK(has("diff.svg", "PROGRAM Main") && !has("diff.svg", "SUBROUTINE Sub"));
	CHECK(!has("diff.svg", "switched off"));
	CHECK(render("--diff " SHAPES " " SHAPES " -o OUT/same.svg") == 0);
	CHECK(has("same.svg", "No rung differs"));
	CHECK(render("--diff ladders/motor.rung ladders/mixer.rung -o OUT/far.svg") == 0);
	CHECK(has("far.svg", ": removed") || has("far.svg", ": added") ||
	      has("far.svg", "differs"));
	g_strfreev(parts);
	g_free(changed);
	g_free(text);
	g_free(path);
}

static int count_of(const char *name, const char *text)
{
	char *all = content(name, NULL);
	int count = 0;

	for (const char *at = all; (at = strstr(at, text)) != NULL; at++)
		count++;
	g_free(all);
	return count;
}

#define EQUALS_NOT ">\xe2\x89\xa0</text>"
#define MINUS ">\xe2\x88\x92</text>"

/* Changed steps, actions and transitions of a chart are marked by signs. */
static void check_diff_chart(void)
{
	static const char chart[] = "PROGRAM Chart SFC\n  INITIAL_STEP S0:\n    Fill(N);\n"
		"    %QX0.1(N);\n  END_STEP\n  STEP S1:\n  END_STEP\n"
		"  TRANSITION FROM S0 TO S1 := I0.1; END_TRANSITION\n"
		"  TRANSITION FROM S1 TO S0:\n    RUNG\n      | NO I0.2 | COIL TRANSITION |\n"
		"  END_TRANSITION\n  ACTION Fill:\n    RUNG\n"
		"      | NO I0.3 | COIL Q0.3 |\n  END_ACTION\nEND_PROGRAM\n";
	static const struct { const char *from, *to; int changed, removed, added; } edit[] = {
		{ "I0.1", "I0.7", 2, 0, 0 },               /* an expression      */
		{ "NO I0.2", "NC I0.2", 2, 0, 0 },         /* a rung             */
		{ "NO I0.3", "NC I0.3", 2, 0, 0 },         /* an action that a line calls */
		{ "%QX0.1(N)", "%QX0.1(P1)", 2, 0, 0 },
		{ "STEP S1:", "STEP S1 (MIN := T#1s):", 2, 0, 0 },
		{ "S1", "S7", 4, 1, 1 },                   /* a step, its ways   */
		{ "END_PROGRAM", "STEP S2:\nEND_STEP\nTRANSITION FROM S2 TO S1 := I0.4; "
		  "END_TRANSITION\nEND_PROGRAM", 0, 0, 2 },
	};

	write_text("a.rung", chart);
	for (int i = 0; i < (int)G_N_ELEMENTS(edit); i++) {
		GString *other = g_string_new(chart);
		/* one in the chart, and one in the list below for each added or removed
		 * line */
		int added = 1, removed = 1;

		g_string_replace(other, edit[i].from, edit[i].to, 0);
		write_text("b.rung", other->str);
		CHECK(render("--diff OUT/a.rung OUT/b.rung -o OUT/c.svg") == 0);
		CHECK(count_of("c.svg", EQUALS_NOT) == edit[i].changed);
		added += edit[i].added;
		removed += edit[i].removed;
		CHECK(count_of("c.svg", ">+</text>") >= added &&
		      count_of("c.svg", MINUS) >= removed);
		g_string_free(other, TRUE);
	}
	write_text("b.rung", "PROGRAM Other SFC\n  INITIAL_STEP S0:\n  END_STEP\nEND_PROGRAM\n");
	CHECK(render("--diff OUT/a.rung OUT/b.rung -o OUT/c.svg") == 0 &&
	      count_of("c.svg", EQUALS_NOT) == 0);
}

/* Below a chart stand the bodies of its actions, in each language. */
static void check_chart_bodies(void)
{
	write_text("a.rung", "PROGRAM Chart SFC\nVAR\n  Level : INT;\nEND_VAR\n  INITIAL_STEP S0:\n    Fill(N);\n"
		   "    Empty(N);\n    Count(N);\n  END_STEP\n"
		   "  ACTION Fill:\n    RUNG\n      | NO %IX0.3 | COIL %QX0.3 |\n  END_ACTION\n"
		   "  ACTION Empty:\n    Level := 12345;\n  END_ACTION\n"
		   "  ACTION Count:\n    LD Level\n    ADD 54321\n    ST Level\n  END_ACTION\nEND_PROGRAM\n");
	CHECK(render("OUT/a.rung -o OUT/bodies.svg") == 0);
	CHECK(has("bodies.svg", "%QX0.3") && has("bodies.svg", "12345") && has("bodies.svg", "54321"));
}

/* A picture has no tooltips: names are not cut. */
static void check_diff_names(void)
{
#define NAME "Pump_of_the_northern_well_is_ready_to_run"
	write_text("a.rung", "VAR\n  " NAME " : BOOL;\nEND_VAR\n\nPROGRAM Main LD\nRUNG\n"
		   "  | NO " NAME " | COIL %QX0.0 |\nEND_PROGRAM\n");
	write_text("b.rung", "VAR\n  " NAME " : BOOL;\nEND_VAR\n\nPROGRAM Main LD\nRUNG\n"
		   "  | NC " NAME " | COIL %QX0.0 |\nEND_PROGRAM\n");
	CHECK(render("--diff OUT/a.rung OUT/b.rung --dark -o OUT/names.svg") == 0);
	CHECK(has("names.svg", ">" NAME "<") && !has("names.svg", "\xe2\x80\xa6"));
#undef NAME
}

/* Declarations are compared as text, lists line by line, a chart before and after. */
static void check_diff_besides(void)
{
	write_text("a.rung", "VAR\n  Stop AT %IX0.1 : BOOL;\nEND_VAR\nPROGRAM Main LD\n"
		   "VAR\n  Own : INT;\nEND_VAR\nRUNG\n  | NO Stop | COIL %QX0.0 |\n"
		   "END_PROGRAM\nPROGRAM List IL\n  LD Stop\n  ST %QX0.1\nEND_PROGRAM\n"
		   "PROGRAM Chart SFC\n  INITIAL_STEP S0:\n  END_STEP\n"
		   "  STEP S1:\n  END_STEP\n"
		   "  TRANSITION FROM S0 TO S1 := I0.1; END_TRANSITION\n"
		   "  TRANSITION FROM S1 TO S0 := I0.2; END_TRANSITION\nEND_PROGRAM\n");
	char *text = content("a.rung", NULL);
	GString *other = g_string_new(strchr(text, '\n') + 1);
	g_string_replace(other, "AT %IX0.1", "AT %IX0.7", 0);
	g_string_replace(other, "INT", "INT := 3", 1);
	write_text("b.rung", other->str);
	CHECK(render("--diff OUT/a.rung OUT/b.rung -o OUT/words.svg") == 0);
	CHECK(has("words.svg", "variable Stop: address %IX0.1 -&gt; %IX0.7") &&
	      has("words.svg", "Main variable Own: initial value nothing -&gt; 3"));
	CHECK(has("words.svg", "No rung differs") && has("words.svg", "Outside the rungs"));
	CHECK(render("--diff OUT/a.rung OUT/b.rung --pou main -o OUT/one.svg") == 0 &&
	      !has("one.svg", "variable Stop") && has("one.svg", "variable Own"));
	g_string_replace(other, "LD Stop", "LDN Stop", 1);
	g_string_replace(other, ":= I0.2", ":= I0.3", 1);
	write_text("b.rung", other->str);
	CHECK(render("--diff OUT/a.rung OUT/b.rung -o OUT/lines.svg") == 0);
	CHECK(has("lines.svg", ">LD Stop</text>") && has("lines.svg", ">LDN Stop</text>") &&
	      has("lines.svg", "PROGRAM List: the instruction list differs"));
	CHECK(has("lines.svg", "PROGRAM Chart: the chart differs") &&
	      has("lines.svg", ">I0.2</text>") && has("lines.svg", ">I0.3</text>") &&
	      has("lines.svg", ">TRANSITION FROM S1 TO S0 := I0.3; END_TRANSITION</text>"));
	CHECK(has("lines.svg", ">+</text>") && has("lines.svg", ">\xe2\x88\x92</text>"));
	CHECK(!has("lines.svg", "No rung differs"));
	g_string_free(other, TRUE);
	g_free(text);
}

/* Networks are drawn, one by its number, marked, and in a comparison those that differ. */
static void check_networks(void)
{
#define LINES(op) "PROGRAM Main FBD\nVAR\n  Start, Stop, Motor : BOOL;\n  Delay : TON;\nEND_VAR\n" \
	"NETWORK \"First\"\n  Delay(IN := Start AND NOT Stop, PT := T#5s)\n" \
	"NETWORK Last \"Second\"\n  Motor := Delay.Q " op " Start\nEND_PROGRAM\n"
	write_text("a.rung", LINES("OR"));
	write_text("b.rung", LINES("XOR") "PROGRAM More FBD\nVAR\n  Lamp : BOOL;\nEND_VAR\n"
		   "NETWORK \"Third\"\n  Lamp := NOT Lamp\nEND_PROGRAM\n");
	CHECK(render("OUT/a.rung -o OUT/fbd.svg") == 0);
	CHECK(has("fbd.svg", ">First</text>") && has("fbd.svg", ">T#5s</text>") && has("fbd.svg", ">Last:</text>"));
	CHECK(has("fbd.svg", ">TON</text>") && has("fbd.svg", ">OR</text>") && has("fbd.svg", ">Delay.Q</text>"));
	CHECK(render("OUT/a.rung --rung 2 -o OUT/fbd.svg") == 0);
	CHECK(!has("fbd.svg", ">TON</text>") && has("fbd.svg", ">OR</text>"));
	CHECK(render("OUT/a.rung --rung 3 -o OUT/fbd.svg") == 2);
	CHECK(render("OUT/a.rung -o OUT/fbd.pdf --paper a5") == 0);
	CHECK(render("--diff OUT/a.rung OUT/b.rung -o OUT/fbd.svg") == 0);
	CHECK(!has("fbd.svg", ">First</text>") && has("fbd.svg", ">OR</text>") && has("fbd.svg", ">XOR</text>"));
	CHECK(has("fbd.svg", ">+</text>") && has("fbd.svg", ">\xe2\x88\x92</text>") &&
	      has("fbd.svg", "PROGRAM More: added") && has("fbd.svg", ">Third</text>"));
	CHECK(render("--diff OUT/a.rung OUT/a.rung -o OUT/fbd.svg") == 0 && has("fbd.svg", "No rung differs"));
	write_text("wrong.rung", LINES("OR 5 OR"));
	CHECK(render("OUT/wrong.rung --check -o OUT/fbd.svg") == 1);
#undef LINES
}

/* An added contact moves the output, which is no change. */
static void check_moved(void)
{
	char *text, **parts;

	write_rung("one.rung", "  | NO %IX0.0 | COIL %QX0.0 |\n  | NO %IX0.1 ^ |\n");
	write_rung("two.rung", "  | NO %IX0.0 | NC %IX0.2 | COIL %QX0.0 |\n"
		   "  | NO %IX0.1 ^ |\n");
	CHECK(render("--diff OUT/one.rung OUT/two.rung -o OUT/moved.svg") == 0);
	text = content("moved.svg", NULL);
	parts = g_strsplit(text, ">\xe2\x89\xa0</text>", -1);
	CHECK_AS(g_strv_length(parts) == 2, "only the new contact is marked");
	g_strfreev(parts);
	g_free(text);
}

static void check_wrong(void)
{
	static const struct { const char *words, *said; int status; } wrong[] = {
		{ "", "a file is missing", 2 },
		{ SHAPES, "-o is missing", 2 },
		{ SHAPES " -o OUT/a.gif", ".svg, .pdf or .png", 2 },
		{ SHAPES " " SHAPES " -o OUT/a.svg", "one file too many", 2 },
		{ SHAPES " --rung 0 -o OUT/a.svg", "a number from 1", 2 },
		{ SHAPES " --rung 1x -o OUT/a.svg", "a number from 1", 2 },
		{ SHAPES " --rung 99 -o OUT/a.svg", "has no rung 99", 2 },
		{ SHAPES " --pou Nobody -o OUT/a.svg", "no POU called Nobody", 2 },
		{ SHAPES " --paper a9 -o OUT/a.pdf", "--paper is", 2 },
		{ SHAPES " --show all -o OUT/a.svg", "--show is", 2 },
		{ SHAPES " --scale", "--scale needs a value", 2 },
		{ SHAPES " --what -o OUT/a.svg", "“--what” is not an option", 2 },
		{ SHAPES " -o OUT/no/such/folder.svg", "unchanged: No such file", 2 },
		{ SHAPES " -o OUT/no/such/folder.pdf", "unchanged: No such file", 2 },
		{ SHAPES " -o OUT/no/such/folder.png", "unchanged: No such file", 2 },
		{ SHAPES " --scale 10 --width 9000 -o OUT/a.png", "too large", 2 },
		{ "OUT/none.rung -o OUT/a.svg", "LD0", 2 },
		{ "OUT/bad.rung -o OUT/a.svg", "LD1", 1 },
		{ "--diff " SHAPES " -o OUT/a.svg", "a file is missing", 2 },
		{ "--diff OUT/bad.rung " SHAPES " -o OUT/a.svg", "LD1", 1 },
		{ "--diff " SHAPES " " SHAPES " --rung 1 -o OUT/a.svg", "--diff", 2 },
	};
	char *bad = in_folder("bad.rung");

	g_file_set_contents(bad, "RUNGBOARD 1\nPROGRAM Main LD\nRUNG\n  | NOO X |\n"
			    "END_PROGRAM\n", -1, NULL);
	for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
		int status = render(*wrong[i].words ? wrong[i].words : "--dark");

		if (!CHECK_AS(status == wrong[i].status && strstr(said, wrong[i].said),
			      wrong[i].said))
			printf("# status %d: %s", status, said);
	}
	g_free(bad);
}

static int count_files(void)
{
	GDir *dir = g_dir_open(folder, 0, NULL);
	int count = 0;

	while (dir && g_dir_read_name(dir))
		count++;
	if (dir)
		g_dir_close(dir);
	return count;
}

/* On a full disk path and reason are reported, and the old file stays. */
static void check_full(const char *name)
{
	char *path = in_folder(name), *words = g_strdup_printf(SHAPES " -o OUT/%s", name);

	CHECK(g_file_set_contents(path, OLD, -1, NULL));
	const int files = count_files();
	struct rlimit limit;
	getrlimit(RLIMIT_FSIZE, &limit);
	setrlimit(RLIMIT_FSIZE, &(struct rlimit){ FULL_BYTES, limit.rlim_max });
	CHECK(render(words) == 2);
	setrlimit(RLIMIT_FSIZE, &limit);
	if (!CHECK(strstr(said, path) && strstr(said, "File too large")))
		printf("# %s\n", said);
	char *now = content(name, NULL);
	CHECK_TEXT(now, OLD);
	CHECK_AS(count_files() == files, "no temporary file is left");
	CHECK(render(words) == 0 && !has(name, OLD));
	g_free(now);
	g_free(words);
	g_free(path);
}

static void check_large(void)
{
	char *path = in_folder("huge.rung");

	CHECK(g_file_set_contents(path, "", 0, NULL) && truncate(path, HUGE_BYTES) == 0);
	CHECK(render("OUT/huge.rung -o OUT/a.svg") == 2);
	CHECK(g_str_has_prefix(said, path));
	/* GLib puts a no-break space before the unit. */
	if (!CHECK(strstr(said, ": error LD004: file is too large: 1.1\302\240TB, "
			  "at most 67.1\302\240MB\n")))
		printf("# %s", said);
	g_free(path);
}

static void check_marks(void)
{
	char *path = in_folder("wrong.rung");

	g_file_set_contents(path, "RUNGBOARD 1\nVAR\n  A : BOOL;\nEND_VAR\n"
			    "PROGRAM Main LD\nRUNG\n  | NO A | NO Missing | COIL A |\n"
			    "END_PROGRAM\n", -1, NULL);
	CHECK(render("OUT/wrong.rung -o OUT/plain.svg") == 0);
	CHECK(!has("plain.svg", "<polyline"));
	CHECK(render("--check OUT/wrong.rung -o OUT/wrong.svg") == 1);
	CHECK(strstr(said, "rung 1 (1,2)") && strstr(said, "Missing"));
	CHECK(has("wrong.svg", "<polyline") &&
	      has("wrong.svg", "<text class=\"symbol f-error\""));
	CHECK(render("--check " SHAPES " -o OUT/a.pdf") == 2);
	g_free(path);
}

/* The documentation has every option of the help, and no other. */
static void check_document(void)
{
	char *text = NULL, *place;
	int missing = 0, options = 0;

	CHECK(g_file_get_contents("docs/pictures.md", &text, NULL, NULL));
	int keep = dup(1);
	char *path = in_folder("help");
	fflush(stdout);
	if (freopen(path, "w", stdout)) {
		render("--help");
		fflush(stdout);
	}
	dup2(keep, 1);
	close(keep);
	char *help = content("help", NULL);
	for (place = help; (place = strstr(place, "--")); place += 2) {
		size_t len = strspn(place + 2, "abcdefghijklmnopqrstuvwxyz") + 2;
		char *option = g_strndup(place, len);

		options++;
		missing += !text || !strstr(text, option);
		g_free(option);
	}
	CHECK(options > 12);
	CHECK_AS(missing == 0, "docs/pictures.md names each option");
	g_free(help);
	g_free(path);
	g_free(text);
}

/* A comment that does not fit at its element is listed below the rungs, and below each
 * compared rung. */
static void check_remarks(void)
{
#define REMARK(end) "PROGRAM Main LD\nRUNG\n  | NO %IX0.0 (* closed while the drive of the " \
		    "northern pump has no fault and its key is " end " *) " \
		    "| NC %IX0.1 (* short *) | COIL %QX0.0 |\nEND_PROGRAM\n"
	write_text("auto.rung", REMARK("in auto"));
	write_text("manual.rung", REMARK("in manual"));
	CHECK(render("OUT/auto.rung -o OUT/remark.svg") == 0);
	CHECK(has("remark.svg", ">Comments</text>") && has("remark.svg", ">1 (1,1) %IX0.0: "));
	CHECK(has("remark.svg", "in auto</text>") && !has("remark.svg", "%IX0.1: short"));
	CHECK(render("--diff OUT/auto.rung OUT/manual.rung -o OUT/remarks.svg") == 0);
	CHECK(has("remarks.svg", "in auto</text>") && has("remarks.svg", "in manual</text>"));
	CHECK(render(SHAPES " -o OUT/none.svg") == 0 && !has("none.svg", ">Comments</text>"));
#undef REMARK
}

/* px of the left end of a text in a picture; -1: not found. */
static double left_of(const char *name, const char *text)
{
	char *svg = content(name, NULL), *whole = g_strdup_printf(">%s</text>", text);
	const char *at = strstr(svg, whole), *x = NULL;

	for (const char *next = svg; at && (next = strstr(next, " x=\"")) && next < at; next++)
		x = next;
	const double left = x ? g_ascii_strtod(x + 4, NULL) : -1;
	g_free(whole);
	g_free(svg);
	return left;
}

/* A comment has room below a comparison of values and beside the mark of a difference. */
static void check_room(void)
{
#define ROOM(end) "PROGRAM Main LD\nRUNG\n  | NO %IX0.0 (* closed while the drive of the pump" end \
		  " *) | [ %MW0 > 1 ] (* the level in the second tank is high *) " \
		  "| COIL %QX0.0 |\nEND_PROGRAM\n"
	write_text("room.rung", ROOM(""));
	write_text("rooms.rung", ROOM("s"));
	CHECK(render("OUT/room.rung -o OUT/room.svg") == 0);
	CHECK(has("room.svg", ">the level in the second tank is high</text>"));
	CHECK(render("--diff OUT/room.rung OUT/rooms.rung -o OUT/rooms.svg") == 0);
	CHECK(left_of("rooms.svg", "\xe2\x89\xa0") > 0);
	CHECK(left_of("rooms.svg", "closed while the drive of the pump") >
	      left_of("rooms.svg", "\xe2\x89\xa0") + 10);
#undef ROOM
}

/* A ClassicLadder project: imported, original, both; refused for other projects. */
static void check_original(void)
{
#define CLASSIC "tests/classic/projects/linuxcnc.clp"
	CHECK(render(CLASSIC " --rung 3 -o OUT/after.svg") == 0);
	CHECK(has("after.svg", ">TM0<") && !has("after.svg", ">%TM0<"));
	CHECK(render(CLASSIC " --rung 3 --original -o OUT/before.svg") == 0);
	CHECK(has("before.svg", ">%TM0<") && !has("before.svg", ">TM0<"));
	CHECK(has("before.svg", ">103<") && !has("before.svg", ">Estop chain<"));
	CHECK(render(CLASSIC " --before-after -o OUT/both.svg") == 0);
	CHECK(has("both.svg", ">%TM0<") && has("both.svg", ">TM0<"));
	CHECK(has("both.svg", ">Estop chain<") && has("both.svg", ">Here: Power, rung 1<"));
	CHECK(render(SHAPES " --original -o OUT/none.svg") == 2);
	CHECK(strstr(said, "does not come from ClassicLadder"));
	CHECK(render(CLASSIC " --original -o OUT/a.pdf") == 2);
	CHECK(render(CLASSIC " --rung 99 --original -o OUT/none.svg") == 2);
#undef CLASSIC
}

int main(void)
{
	folder = g_dir_make_tmp("render-XXXXXX", NULL);
	if (!CHECK(folder))
		return tap_done();
	signal(SIGXFSZ, SIG_IGN); /* as in the program: a size limit counts as a full disk */
	check_svg();
	check_png();
	check_diff();
	check_diff_besides();
	check_diff_chart();
	check_chart_bodies();
	check_diff_names();
	check_networks();
	check_moved();
	check_wrong();
	check_full("full.svg");
	check_full("full.png");
	check_full("full.pdf");
	check_large();
	check_marks();
	check_remarks();
	check_room();
	check_original();
	check_document();
	clear_folder();
	g_free(folder);
	g_free(said);
	return tap_done();
}
