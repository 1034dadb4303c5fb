/* SPDX-License-Identifier: MIT
 *
 * test_scope - the meaning of operands: which declaration is used, and what may be
 * written.
 */
#include "engine/check/scope.h"
#include "tests/tap.h"

static struct project *project;
static struct arena arena;

static uint32_t id(const char *text)
{
	return names_intern(&project->names, text, strlen(text));
}

static struct var var(const char *name, enum iec_type type, enum word fb,
		      const char *at)
{
	struct var out = { .name = id(name), .type = type, .fb = fb };

	out.fold = names_fold(&project->names, out.name);
	if (at)
		iec_addr_parse(at, strlen(at), &out.at);
	return out;
}

/* Globals: Motor, START at an input, Delay : TON, M1, a constant, a double.
 * Locals of the one POU: motor : INT and T37 : CTU. */
static void fill(void)
{
	static struct var globals[6], locals[2];
	static struct var_block blocks[2] = {
		{ .flags = 0, .first = 0, .count = 4 },
		{ .flags = VAR_CONSTANT, .first = 4, .count = 2 },
	};
	static struct var_block local_block = { .first = 0, .count = 2 };
	static struct pou pou;

	globals[0] = var("Motor", IEC_BOOL, ELEM_EMPTY, "%QX0.0");
	globals[1] = var("START", IEC_BOOL, ELEM_EMPTY, "%IX0.0");
	globals[2] = var("Delay", IEC_NONE, FB_TON, NULL);
	globals[3] = var("M1", IEC_BOOL, ELEM_EMPTY, NULL);
	globals[4] = var("Most", IEC_INT, ELEM_EMPTY, NULL);
	globals[5] = var("DELAY", IEC_BOOL, ELEM_EMPTY, NULL);
	locals[0] = var("motor", IEC_INT, ELEM_EMPTY, NULL);
	locals[1] = var("T37", IEC_NONE, FB_CTU, NULL);
	project->globals = (struct var_table){ globals, 6, blocks, 2 };
	pou.name = id("Main");
	pou.vars = (struct var_table){ locals, 2, &local_block, 1 };
	project->pou = &pou;
	project->pou_count = 1;
}

static const struct meaning *find(struct scope *scope, const char *text)
{
	enum diag_id why;

	return scope_find(scope, project->pou, id(text), &why);
}

static enum diag_id reason(struct scope *scope, const char *text)
{
	enum diag_id why = DIAG_COUNT;

	CHECK(!scope_find(scope, project->pou, id(text), &why));
	return why;
}

static void test_variables(struct scope *scope)
{
	const struct meaning *m = find(scope, "MOTOR");
	enum diag_id why;

	CHECK(m && m->kind == MEANING_VARIABLE && m->type == IEC_INT);
	CHECK(m && m->pou == project->pou && m->index == 0 && m->writable);
	CHECK(m && m->addr.area == AREA_NONE);
	CHECK(find(scope, "MOTOR") == m);
	m = scope_find(scope, NULL, id("MOTOR"), &why);
	CHECK(m && m->type == IEC_BOOL && !m->pou && m->writable);
	CHECK(m && m->addr.area == AREA_Q);
	m = find(scope, "Start");
	CHECK(m && m->var && !m->writable && !m->constant);
	m = find(scope, "most");
	CHECK(m && m->constant && !m->writable);
	m = find(scope, "delay");
	CHECK(m && m->kind == MEANING_INSTANCE && m->type == IEC_NONE);
	CHECK(m && m->index == 2 && !m->writable);
	m = scope_find(scope, NULL, id("T37"), &why);
	CHECK(!m && why == DIAG_UNKNOWN_NAME);
}

static void test_pins(struct scope *scope)
{
	const struct meaning *m = find(scope, "delay.q");

	CHECK(m && m->kind == MEANING_PIN && m->type == IEC_BOOL);
	CHECK(m && !m->writable && m->var && m->var->fb == FB_TON);
	m = find(scope, "Delay.PT");
	CHECK(m && m->type == IEC_TIME && m->writable);
	m = find(scope, "t37.cv");
	CHECK(m && m->type == IEC_INT && m->pou == project->pou && m->index == 1);
	CHECK(reason(scope, "Delay.start") == DIAG_NO_PIN);
	CHECK(reason(scope, "Delay.") == DIAG_NO_PIN);
	CHECK(reason(scope, "Motor.Q") == DIAG_UNKNOWN_NAME);
	m = find(scope, "Main.motor"); /* of a program, by its name */
	CHECK(m && m->kind == MEANING_VARIABLE && m->type == IEC_INT && m->pou == project->pou);
	CHECK(reason(scope, "Main.engine") == DIAG_NO_PIN);
	CHECK(reason(scope, ".Q") == DIAG_UNKNOWN_NAME);
}

static void test_addresses(struct scope *scope)
{
	const struct meaning *m = find(scope, "I3");

	CHECK(m && m->kind == MEANING_ADDRESS && m->type == IEC_BOOL);
	CHECK(m && m->addr.area == AREA_I && m->addr.bit == 3 && !m->writable);
	m = find(scope, "M1"); /* a declared name wins */
	CHECK(m && m->kind == MEANING_VARIABLE);
	m = find(scope, "%MX0.1");
	CHECK(m && m->kind == MEANING_ADDRESS && m->writable);
	m = find(scope, "MW4");
	CHECK(m && m->type == IEC_WORD && m->addr.byte == 4);
	m = find(scope, "sys_first_scan");
	CHECK(m && m->kind == MEANING_ADDRESS && m->addr.area == AREA_SM);
	CHECK(m && m->addr.bit == 1 && !m->writable);
	CHECK(reason(scope, "SYS_NOTHING") == DIAG_UNKNOWN_NAME);
	CHECK(reason(scope, "%IX99999.0") == DIAG_BAD_ADDRESS);
	CHECK(reason(scope, "%ZX0.0") == DIAG_NOT_ADDRESS);
	CHECK(reason(scope, "Nobody") == DIAG_UNKNOWN_NAME);
	CHECK(reason(scope, "") == DIAG_UNKNOWN_NAME);
}

static void test_literals(struct scope *scope)
{
	const struct meaning *m = find(scope, "T#3s");

	CHECK(m && m->kind == MEANING_LITERAL && m->type == IEC_TIME);
	CHECK(m && m->literal.value.i == 3000000000 && !m->writable);
	m = find(scope, "16#FF");
	CHECK(m && m->type == IEC_NONE && m->literal.value.i == 255);
	CHECK(reason(scope, "T#5x") == DIAG_BAD_LITERAL);
	CHECK(reason(scope, "INT#40000") == DIAG_LITERAL_RANGE);
}

/* Looks up more names than the first table of answers holds. */
static void test_many(struct scope *scope)
{
	const struct meaning *first[2000];
	char text[32];
	bool same = true, right = true;

	for (int i = 0; i < 2000; i++) {
		snprintf(text, sizeof(text), "%%MX%d.%d", i / 8, i % 8);
		first[i] = find(scope, text);
		right &= first[i] && first[i]->addr.byte == (uint32_t)i / 8;
	}
	for (int i = 0; i < 2000; i++) {
		snprintf(text, sizeof(text), "%%MX%d.%d", i / 8, i % 8);
		same &= find(scope, text) == first[i];
	}
	CHECK(right);
	CHECK(same);
}

int main(void)
{
	struct scope *scope;

	project = project_new("test.rung");
	if (!CHECK(project != NULL))
		return tap_done();
	fill();
	arena_init(&arena);
	scope = scope_new(project, &arena);
	CHECK(scope_duplicate(scope, NULL, 5) == 2);
	CHECK(scope_duplicate(scope, NULL, 2) == -1);
	CHECK(scope_duplicate(scope, project->pou, 0) == -1);
	test_variables(scope);
	test_pins(scope);
	test_addresses(scope);
	test_literals(scope);
	test_many(scope);
	arena_free(&arena);
	project->pou = NULL;
	project->pou_count = 0;
	project_free(project);
	return tap_done();
}
