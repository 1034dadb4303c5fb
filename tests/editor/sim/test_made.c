/* SPDX-License-Identifier: MIT
 *
 * test_made - what a scan leaves of each box of a network, also of those whose result no variable has.
 *
 * Random networks run twice: as they are, and with a line more for each box that stores the same text in a variable.
 * The result of each box must be the value of that variable. No display.
 */
#include "editor-gtk/edit/fbd_lines.h"
#include "editor-gtk/sim/live_map.h"
#include "editor-gtk/sim/live_value.h"
#include "editor-gtk/sim/sim_program.h"

#include "engine/ladder.h"
#include "engine/model/fbd_graph.h"
#include "engine/trial/twin.h"
#include "tests/tap.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PROGRAMS 150
#define SCANS 6

static const char DECLARED[] =
	"RUNGBOARD 1\n\nVAR\n  A AT %IX0.0 : BOOL;\n  B AT %IX0.1 : BOOL;\n  C AT %IX0.2 : BOOL;\n"
	"  I AT %IW2 : INT;\n  J AT %IW4 : INT;\n  P : INT := 3;\n  R : REAL := 2.5;\n  W AT %IW6 : WORD;\n  D : DINT := 70000;\n"
	"  Text : STRING := 'abc';\n  T1 : TON;\n";

/* ---- random networks ---- */

static GRand *dice;

static int one_of(int count)
{
	return (int)g_rand_int_range(dice, 0, count);
}

enum kind { OF_BOOL, OF_INT, OF_REAL, OF_WORD };

static void add(GString *out, enum kind kind, int depth);

static void add_two(GString *out, enum kind kind, const char *sign, int depth)
{
	const bool closed = one_of(2);

	g_string_append(out, closed ? "(" : "");
	add(out, kind, depth - 1);
	g_string_append_printf(out, " %s ", sign);
	g_string_append_c(out, '(');
	add(out, kind, depth - 1);
	g_string_append(out, closed ? "))" : ")");
}

static void add_bool(GString *out, int depth)
{
	static const char *const names[] = { "A", "B", "C", "T1.Q", "I.3" };
	static const char *const signs[] = { "AND", "OR", "XOR" };
	static const char *const tests[] = { "<", ">", "=", "<>", "<=", ">=" };

	switch (depth > 0 ? one_of(8) : 0) {
	case 0:
		g_string_append(out, names[one_of(G_N_ELEMENTS(names))]);
		break;
	case 1:
	case 2:
		add_two(out, OF_BOOL, signs[one_of(G_N_ELEMENTS(signs))], depth);
		break;
	case 3:
		g_string_append(out, "NOT (");
		add(out, OF_BOOL, depth - 1);
		g_string_append_c(out, ')');
		break;
	case 4:
		add_two(out, one_of(2) ? OF_INT : OF_REAL, tests[one_of(G_N_ELEMENTS(tests))], depth);
		break;
	case 5:
		g_string_append(out, "AND(");
		add(out, OF_BOOL, depth - 1);
		g_string_append(out, ", ");
		add(out, OF_BOOL, depth - 1);
		g_string_append(out, ", B)");
		break;
	case 6:
		g_string_append(out, "SEL(");
		add(out, OF_BOOL, depth - 1);
		g_string_append(out, ", A, ");
		add(out, OF_BOOL, depth - 1);
		g_string_append_c(out, ')');
		break;
	default:
		g_string_append(out, "GT(");
		add(out, OF_INT, depth - 1);
		g_string_append(out, ", ");
		add(out, OF_INT, depth - 1);
		g_string_append_c(out, ')');
		break;
	}
}

static void add_call(GString *out, const char *name, enum kind kind, int inputs, int depth)
{
	g_string_append_printf(out, "%s(", name);
	for (int i = 0; i < inputs; i++) {
		g_string_append(out, i ? ", " : "");
		add(out, kind, depth - 1);
	}
	g_string_append_c(out, ')');
}

static void add_number(GString *out, enum kind kind, int depth)
{
	static const char *const ints[] = { "I", "J", "P", "7", "-3" }, *const reals[] = { "R", "1.5", "-0.25" };
	static const char *const signs[] = { "+", "-", "*" };

	switch (depth > 0 ? one_of(7) : 0) {
	case 0:
		g_string_append(out, kind == OF_INT ? ints[one_of(G_N_ELEMENTS(ints))] : reals[one_of(G_N_ELEMENTS(reals))]);
		break;
	case 1:
	case 2:
		add_two(out, kind, signs[one_of(G_N_ELEMENTS(signs))], depth);
		break;
	case 3:
		add_call(out, "MAX", kind, 2 + one_of(2), depth);
		break;
	case 4:
		add_call(out, "LIMIT", kind, 3, depth);
		break;
	case 5:
		if (kind == OF_REAL)
			add_call(out, "INT_TO_REAL", OF_INT, 1, depth);
		else if (one_of(2))
			add_call(out, "Half", OF_INT, 1, depth);
		else
			add_call(out, "ABS", OF_INT, 1, depth);
		break;
	default:
		g_string_append(out, "SEL(");
		add(out, OF_BOOL, depth - 1);
		g_string_append(out, ", ");
		add(out, kind, depth - 1);
		g_string_append(out, ", ");
		add(out, kind, depth - 1);
		g_string_append_c(out, ')');
		break;
	}
}

static void add_word(GString *out, int depth)
{
	switch (depth > 0 ? one_of(4) : 0) {
	case 0:
		g_string_append(out, "W");
		break;
	case 1:
		add_two(out, OF_WORD, one_of(2) ? "AND" : "XOR", depth);
		break;
	case 2:
		g_string_append(out, "SHL(");
		add(out, OF_WORD, depth - 1);
		g_string_append(out, ", 2)");
		break;
	default:
		g_string_append(out, "NOT (");
		add(out, OF_WORD, depth - 1);
		g_string_append_c(out, ')');
		break;
	}
}

static void add(GString *out, enum kind kind, int depth)
{
	if (kind == OF_BOOL)
		add_bool(out, depth);
	else if (kind == OF_WORD)
		add_word(out, depth);
	else
		add_number(out, kind, depth);
}

static char *random_networks(void)
{
	GString *out = g_string_new(NULL);
	int lines = 0;

	for (int i = 1 + one_of(3); i > 0; i--) {
		g_string_append(out, "NETWORK\n");
		for (int k = 1 + one_of(3); k > 0; k--) {
			const enum kind kind = (enum kind)one_of(4);

			g_string_append_printf(out, "  Wire%d := ", ++lines);
			add(out, kind, 1 + one_of(4));
			g_string_append_c(out, '\n');
		}
	}
	return g_string_free(out, FALSE);
}

/* ---- a program that runs ---- */

struct run {
	struct sim_program *program;
	struct twin twin;
	struct live_map *map;
};

static bool begin(struct run *run, const char *more, const char *networks)
{
	char *text = g_strdup_printf("%s%sEND_VAR\n\n"
		"FUNCTION Half : INT ST\nVAR_INPUT\n  Value : INT;\nEND_VAR\n  Half := Value / 2;\nEND_FUNCTION\n\n"
		"PROGRAM Main FBD\n%sEND_PROGRAM\n", DECLARED, more, networks);
	GError *error = NULL;

	*run = (struct run){ .program = sim_program_read_listed(ladder_new(), g_intern_static_string("-"), text, strlen(text), &error) };
	if (!run->program || !twin_init(&run->twin, run->program->program, NULL, 10000000)) {
		printf("# %s\n%s\n", error ? error->message : "no memory", text);
		g_clear_error(&error);
		g_free(text);
		return false;
	}
	run->twin.resource.watch = true;
	twin_act(&run->twin, &(struct act){ .kind = ACT_START });
	run->map = live_map_new(&run->twin.resource, "Main", NULL);
	g_free(text);
	return true;
}

static void end(struct run *run)
{
	live_map_free(run->map);
	twin_free(&run->twin);
	sim_program_unref(run->program);
}

static union iec_value value_of(struct run *run, struct location at)
{
	return image_get(&run->twin.resource.image, at);
}

static void set(struct run *run, const char *name, int64_t value)
{
	const struct location at = live_map_find(run->map, name, strlen(name));

	image_set(&run->twin.resource.image, at, (union iec_value){ .i = value });
}

static void scan(struct run *run, guint32 bits)
{
	set(run, "A", bits & 1);
	set(run, "B", bits >> 1 & 1);
	set(run, "C", bits >> 2 & 1);
	set(run, "I", (int64_t)(bits >> 3 & 63) - 20);
	set(run, "J", (int64_t)(bits >> 9 & 63) - 20);
	set(run, "W", bits >> 12 & 0xffff);
	twin_scan(&run->twin);
}

/* ---- the two agree ---- */

struct probe {
	int network, box;
	char name[16];
};

/* Where the result of a box is; type IEC_NONE: nowhere. */
static struct location place_of(const struct run *run, const struct fbd_box *box, bool *ran)
{
	const struct project *project = ladder_project(run->program->ladder);
	struct live_result result = { .at.type = IEC_NONE };
	int first, last, pou = 0;

	while (pou + 1 < project->pou_count && !project->pou[pou].fbd)
		pou++;
	if (!fbd_lines_place(project, &project->pou[pou], box->item, &first, &last) ||
	    !live_map_made(run->map, ladder_il(run->program->ladder, pou), first, last, box->made, &result))
		return (struct location){ .type = IEC_NONE };
	*ran = image_get(&run->twin.resource.image, (struct location){ .type = IEC_BOOL, .where = result.ran }).i;
	return result.at;
}

static int boxes, unknown, compared;

static const struct pou *networks_of(const struct run *run)
{
	const struct project *project = ladder_project(run->program->ladder);

	for (int i = 0; i < project->pou_count; i++)
		if (project->pou[i].fbd)
			return &project->pou[i];
	return NULL;
}

/* Each line with a line `ProbeN := text` above it for each of its boxes, which @more declares. */
static void add_line(const struct run *run, const struct fbd_graph *graph, int network, int item, GString *out,
		     GString *more, GArray *probes)
{
	const char *text = fbd_lines_text(ladder_project(run->program->ladder), networks_of(run), item);

	for (int i = 0; i < graph->box_count; i++) {
		const struct fbd_box *box = &graph->box[i];
		struct probe probe = { .network = network, .box = i };
		struct location at;
		bool ran;

		if (box->item != item || !box->made)
			continue;
		at = place_of(run, box, &ran);
		boxes++;
		unknown += at.type == IEC_NONE;
		if (at.type == IEC_NONE)
			continue;
		snprintf(probe.name, sizeof(probe.name), "Probe%u", probes->len);
		g_string_append_printf(more, "  %s : %s;\n", probe.name, iec_type_row(at.type)->word);
		g_string_append_printf(out, "  %s := %.*s\n", probe.name, box->len, text + box->at);
		g_array_append_val(probes, probe);
	}
	g_string_append_printf(out, "  %s\n", text);
}

static char *with_probes(const struct run *run, GString *more, GArray *probes)
{
	const struct pou *pou = networks_of(run);
	GString *out = g_string_new(NULL);

	for (int n = 0; n < fbd_lines_count(pou); n++) {
		struct fbd_graph graph;
		int last = -1;

		if (!fbd_graph_make(ladder_project(run->program->ladder), pou, n, &graph))
			break;
		g_string_append(out, "NETWORK\n");
		for (int i = 0; i < graph.box_count; i++)
			if (graph.box[i].item > last) {
				last = graph.box[i].item;
				add_line(run, &graph, n, last, out, more, probes);
			}
		fbd_graph_free(&graph);
	}
	return g_string_free(out, FALSE);
}

static int64_t errors_of(struct run *run)
{
	return value_of(run, live_map_find(run->map, "SYS_ERRORS", 10)).i;
}

/* After a scan of both: the result of each box is what its probe got. */
static bool agree(struct run *plain, struct run *probed, GArray *probes)
{
	for (guint i = 0; i < probes->len; i++) {
		const struct probe *probe = &g_array_index(probes, struct probe, i);
		const struct location wanted = live_map_find(probed->map, probe->name, strlen(probe->name));
		char one[IEC_VALUE_TEXT], other[IEC_VALUE_TEXT];
		struct fbd_graph graph;
		struct location at;
		bool ran = false;

		if (!fbd_graph_make(ladder_project(plain->program->ladder), networks_of(plain), probe->network, &graph))
			return false;
		at = place_of(plain, &graph.box[probe->box], &ran);
		fbd_graph_free(&graph);
		live_value_print(wanted.type, value_of(probed, wanted), other, sizeof(other));
		live_value_print(at.type, value_of(plain, at), one, sizeof(one));
		if (!ran || at.type != wanted.type || strcmp(one, other) != 0) {
			printf("# %s: %s, %s%s\n", probe->name, one, other, ran ? "" : ", not run");
			return false;
		}
	}
	return true;
}

static bool test_one(guint32 seed)
{
	GString *more = g_string_new(NULL);
	GArray *probes = g_array_new(FALSE, TRUE, sizeof(struct probe));
	struct run plain, probed;
	char *networks, *more_networks = NULL;
	bool good;

	dice = g_rand_new_with_seed(seed);
	networks = random_networks();
	good = begin(&plain, "", networks);
	if (good) {
		more_networks = with_probes(&plain, more, probes);
		good = begin(&probed, more->str, more_networks);
		for (int i = 0; good && i < SCANS; i++) {
			const guint32 bits = g_rand_int(dice);

			scan(&plain, bits);
			scan(&probed, bits);
			if (errors_of(&probed)) /* what comes behind an overflow is not computed */
				continue;
			compared++;
			good = agree(&plain, &probed, probes);
		}
		end(&plain);
		if (probed.program)
			end(&probed);
	}
	if (!good)
		printf("# seed %u:\n%s%s", seed, networks, more_networks ? more_networks : "");
	g_rand_free(dice);
	g_array_unref(probes);
	g_string_free(more, TRUE);
	g_free(networks);
	g_free(more_networks);
	return good;
}

int main(int argc, char **argv)
{
	const guint32 first = argc > 1 ? (guint32)strtoul(argv[1], NULL, 10) : 1;
	const guint32 count = argc > 2 ? (guint32)strtoul(argv[2], NULL, 10) : PROGRAMS;
	bool good = true;

	for (guint32 seed = first; good && seed < first + count; seed++)
		good = test_one(seed);
	CHECK_AS(good, "the result of each box is the value of its text");
	printf("# %d boxes, of %d no result is known; %d scans\n", boxes, unknown, compared);
	CHECK_AS(boxes > 1000 && unknown < boxes / 20, "each box has a result, except operations on constants");
	CHECK_AS(compared > PROGRAMS, "most scans have no overflow");
	return tap_done();
}
