/* SPDX-License-Identifier: MIT
 *
 * test_pou_print - a printed list reads again and is the same list.
 */
#include "engine/model/project.h"
#include "engine/text/text.h"
#include "engine/text/pou_print.h"
#include "tests/tap.h"

static struct diag_list diags;

static struct project *read_text(const char *text)
{
	struct project *project = project_new("test.rung");

	diag_init(&diags);
	CHECK_AS(text_read(project, "test.rung", text, strlen(text), NULL,
			   &diags), "the program can be read");
	return project;
}

static bool same_text(const struct project *a, uint32_t x,
		      const struct project *b, uint32_t y)
{
	return strcmp(project_text(a, x), project_text(b, y)) == 0;
}

static bool same_list(const struct project *a, const struct project *b)
{
	const struct il *x = &a->pou[0].il, *y = &b->pou[0].il;

	if (x->count != y->count)
		return false;
	for (int i = 0; i < x->count; i++)
		if (x->line[i].kind != y->line[i].kind ||
		    x->line[i].op != y->line[i].op ||
		    x->line[i].modifiers != y->line[i].modifiers ||
		    x->line[i].word != y->line[i].word ||
		    !same_text(a, x->line[i].operand, b, y->line[i].operand) ||
		    !same_text(a, x->line[i].pin, b, y->line[i].pin))
			return false;
	return true;
}

int main(void)
{
	struct project *a = read_text(
		"RUNGBOARD 1\n\nPROGRAM Main IL\nVAR\n  T : TON;\nEND_VAR\n"
		"LD A\nANDN(B\nOR C\n)\nST _T1\nCAL T(IN := _T1, PT := T#3s)\n"
		"LD Level\nADD 5\nST Level\n"
		"ADD(EN := A, IN1 := Level, IN2 := 1, OUT => Level)\n"
		"JMPC Out\n(* a note *)\nOut:\nRET\nEND_PROGRAM\n");
	struct var used = { .type = IEC_BOOL }, unused = { .type = IEC_BOOL };
	struct var *temps[] = { &used, &unused };
	struct sink_memory memory;

	sink_memory_init(&memory);
	struct sink sink = sink_to_memory(&memory);
	used.name = names_intern(&a->names, "_T1", 3);
	unused.name = names_intern(&a->names, "_T2", 3);
	sink_text(&sink, "RUNGBOARD 1\n\n");
	CHECK(pou_print_il(a, &a->pou[0], &a->pou[0].vars, temps, 2,
			     &a->pou[0].il, &sink));
	CHECK(strstr(sink_memory_text(&memory), "\nPROGRAM Main IL\n"));
	CHECK(!strstr(sink_memory_text(&memory), "_T2"));

	struct project *b = read_text(sink_memory_text(&memory));
	CHECK(b->pou_count == 1 && b->pou[0].il.count > 10);
	CHECK(same_list(a, b));
	CHECK(b->pou[0].vars.count == 2);
	CHECK_TEXT(project_text(b, b->pou[0].vars.var[1].name), "_T1");
	project_free(a);
	project_free(b);
	sink_memory_free(&memory);
	return tap_done();
}
