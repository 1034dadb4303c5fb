/* SPDX-License-Identifier: MIT
 *
 * test_foreseen - a text that is built before the document has it. Whatever was foreseen, the
 * simulation ends with the program that a build of the whole document gives, byte by byte; if it was typed
 * in another form, with other lines.
 */
#include "editor-gtk/sim/sim.h"
#include "editor-gtk/sim/sim_program.h"
#include "tests/tap.h"

#include <string.h>

static const char SAMPLE[] =
	"RUNGBOARD 1\n\nPROGRAM Main ST\nVAR\n  Count : INT;\nEND_VAR\n  Count := Count + 1;\nEND_PROGRAM\n\n"
	"FUNCTION Twice : INT ST\nVAR_INPUT\n  X : INT;\nEND_VAR\n  Twice := X * 2;\nEND_FUNCTION\n";

static const char OTHER[] =
	"RUNGBOARD 1\n\nPROGRAM Other LD\nRUNG\n  | NO %IX0.1 | COIL %QX0.1 |\nEND_PROGRAM\n";

static LadderDocument *document;
static LadderSim *sim;

/* The text of Main that adds @step. Caller frees. */
static char *adds(int step)
{
	return g_strdup_printf("PROGRAM Main ST\nVAR\n  Count : INT;\nEND_VAR\n"
			       "  Count := Count + %d;\nEND_PROGRAM\n", step);
}

static void foresee(const char *list)
{
	/* After a text that did not come, some are not foreseen. */
	for (int i = 0; i < 21 && ladder_sim_is_on(sim) && !ladder_sim_is_building(sim); i++)
		ladder_sim_foresee(sim, ladder_document_with_list(document, 0, list));
}

static void wait_built(void)
{
	const gint64 end = g_get_monotonic_time() + 60 * G_USEC_PER_SEC;

	while (ladder_sim_is_building(sim) && g_get_monotonic_time() < end)
		g_main_context_iteration(NULL, FALSE);
}

/* Does the program of the simulation have the bytes of a whole build? */
static bool is_whole_build(const struct sim_program *whole)
{
	const struct program *of = ladder_sim_twin(sim)->resource.image.program;

	return of->header->size == whole->program->header->size &&
	       memcmp(of->base, whole->program->base, of->header->size) == 0;
}

/* Has it the bytes of a whole build of its own text, and the code of that of the document? */
static bool is_other_form(const struct sim_program *whole)
{
	const char *text = ladder_sim_text(sim);
	struct sim_program *own = sim_program_read_listed(ladder_new(), "-", text, strlen(text), NULL);
	const bool good = own && is_whole_build(own) && sim_program_runs(own, whole->program);

	sim_program_unref(own);
	return good;
}

static bool becomes_whole_build(void)
{
	const gint64 end = g_get_monotonic_time() + 60 * G_USEC_PER_SEC;
	gsize len;
	char *text = ladder_document_text(document, &len);
	struct sim_program *whole = sim_program_read_listed(ladder_new(), "-", text, len, NULL);
	bool same;

	wait_built();
	while (!(same = is_whole_build(whole) || is_other_form(whole)) && g_get_monotonic_time() < end)
		g_main_context_iteration(NULL, FALSE);
	sim_program_unref(whole);
	g_free(text);
	return same && !ladder_sim_is_building(sim);
}

/* The document gets @is after @foreseen was built, or while it is built. Is another build needed? */
static bool builds_again(const char *foreseen, const char *is, bool built)
{
	bool again;

	foresee(foreseen);
	CHECK(ladder_sim_is_building(sim));
	if (built)
		wait_built();
	CHECK(ladder_document_put_list(document, 0, is));
	again = ladder_sim_is_building(sim);
	CHECK(becomes_whole_build());
	return again;
}

static void test_texts(void)
{
	char *two = adds(2), *three = adds(3), *four = adds(4), *bad = g_strdup("PROGRAM Main ST\n  Count := ;\nEND_PROGRAM\n");

	CHECK_AS(!builds_again(two, two, true), "what was foreseen is ready");
	CHECK(builds_again(three, three, false));
	CHECK_AS(builds_again(two, four, true), "another text is built");
	CHECK(builds_again(three, two, false));
	CHECK_AS(builds_again(bad, three, true), "a text with errors is foreseen in vain");
	CHECK(builds_again(bad, four, false));
	g_free(two);
	g_free(three);
	g_free(four);
	g_free(bad);
}

/* Typed in a form that the document does not write. */
static char *adds_otherwise(int step, int form)
{
	return form == 1 ? g_strdup_printf("PROGRAM Main ST\nVAR\n  Count : INT;\nEND_VAR\n"
					   "Count:=Count+%d;   \nEND_PROGRAM\n", step) :
			   g_strdup_printf("PROGRAM Main ST\nvar Count : INT; end_var\n"
					   "    count:=count + %d;\nEND_PROGRAM\n", step);
}

static void test_forms(void)
{
	char *two = adds_otherwise(2, 1), *same = adds_otherwise(2, 2), *three = adds_otherwise(3, 2);
	const struct program *before;

	CHECK_AS(!builds_again(two, two, true), "the document takes the text in another form: it is not built again");
	before = ladder_sim_twin(sim)->resource.image.program;
	CHECK(!builds_again(same, same, true));
	CHECK_AS(ladder_sim_twin(sim)->resource.image.program == before, "another form is no other program");
	CHECK_AS(builds_again(two, three, true), "another text is built");
	CHECK(builds_again(two, two, false));
	g_free(two);
	g_free(same);
	g_free(three);
}

/* A file beside the document may have changed with the other change. */
static void test_two_changes(void)
{
	char *five = adds(5), *six = adds(6);

	foresee(five);
	wait_built();
	CHECK(ladder_document_put_list(document, 0, six));
	wait_built();
	CHECK(ladder_document_put_list(document, 0, five));
	CHECK_AS(ladder_sim_is_building(sim), "it is foreseen for the next change only");
	CHECK(becomes_whole_build());
	g_free(five);
	g_free(six);
}

/* The program that runs stays while the document has an error. */
static void test_errors(void)
{
	char *seven = adds(7), *unknown = g_strdup("PROGRAM Main ST\n  Nobody := 1;\nEND_PROGRAM\n");
	const struct program *before;

	CHECK(ladder_document_put_list(document, 0, seven) && becomes_whole_build());
	before = ladder_sim_twin(sim)->resource.image.program;
	foresee(unknown);
	wait_built();
	CHECK(ladder_document_put_list(document, 0, unknown));
	CHECK_AS(!ladder_sim_is_building(sim), "its errors were found ahead, too");
	CHECK(ladder_sim_twin(sim)->resource.image.program == before);
	CHECK(builds_again(seven, seven, false));
	g_free(seven);
	g_free(unknown);
}

static void test_random(void)
{
	GRand *random = g_rand_new_with_seed(7);
	bool good = true;

	for (int i = 0; i < 150 && good; i++) {
		const int form = g_rand_int_range(random, 0, 3), step = g_rand_int_range(random, 1, 9);
		char *guess = adds(g_rand_int_range(random, 1, 9)), *is = form ? adds_otherwise(step, form) : adds(step);

		if (g_rand_boolean(random))
			foresee(g_rand_boolean(random) ? is : guess);
		for (int k = g_rand_int_range(random, 0, 4); k > 0; k--)
			g_main_context_iteration(NULL, FALSE);
		if (g_rand_int_range(random, 0, 3) == 0)
			wait_built();
		good = ladder_document_put_list(document, 0, is);
		if (g_rand_int_range(random, 0, 3) == 0)
			good = good && becomes_whole_build();
		g_free(guess);
		g_free(is);
	}
	CHECK(good && becomes_whole_build());
	g_rand_free(random);
}

static int changes;

static void program_changed(LadderSim *of, gpointer unused)
{
	(void)of, (void)unused;
	changes++;
}

/* A build of the simulation before, which ends when another file is simulated already. */
static void test_other_file(void)
{
	char *two = adds(2);
	gint64 end;

	foresee(two);
	wait_built();
	CHECK(becomes_whole_build());
	g_free(two);
	two = adds(7);
	CHECK(ladder_document_put_list(document, 0, two));
	CHECK(ladder_sim_is_building(sim));
	ladder_document_open_text(document, NULL, OTHER, strlen(OTHER), true);
	CHECK(ladder_sim_restart(sim, NULL) && ladder_sim_is_building(sim));
	g_signal_connect(sim, "program-changed", G_CALLBACK(program_changed), NULL);
	CHECK(becomes_whole_build());
	ladder_sim_scan(sim, 3);
	end = g_get_monotonic_time() + 60 * G_USEC_PER_SEC;
	while (ladder_sim_twin(sim)->scan < 3 && g_get_monotonic_time() < end)
		g_main_context_iteration(NULL, FALSE);
	CHECK(becomes_whole_build() && ladder_sim_twin(sim)->scan == 3);
	CHECK_AS(changes == 0, "the file before does not come back");
	g_free(two);
}

int main(void)
{
	document = ladder_document_new();
	sim = ladder_sim_new(document);
	ladder_document_open_text(document, NULL, SAMPLE, strlen(SAMPLE), true);
	ladder_sim_foresee(sim, ladder_document_with_list(document, 0, "PROGRAM Main ST\nEND_PROGRAM\n"));
	CHECK_AS(!ladder_sim_is_building(sim), "nothing is foreseen while the simulation is off");
	CHECK(ladder_sim_begin(sim, NULL));
	test_texts();
	test_forms();
	test_two_changes();
	test_errors();
	test_random();
	CHECK_AS(!ladder_document_with_list(document, 2, "") && !ladder_document_with_list(document, -1, ""),
		 "there is no such POU");
	foresee("PROGRAM Main ST\nEND_PROGRAM\n");
	test_other_file();
	ladder_sim_end(sim);
	wait_built();
	CHECK(!ladder_sim_is_building(sim));
	foresee("PROGRAM Main ST\nEND_PROGRAM\n");
	CHECK(!ladder_sim_is_building(sim));
	g_object_unref(sim);
	g_object_unref(document);
	return tap_done();
}
