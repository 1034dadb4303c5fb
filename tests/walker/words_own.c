/* SPDX-License-Identifier: MIT
 *
 * words_own - functions, function blocks and structures of a random program's own.
 *
 * Their declarations are fixed, their rungs are random. Their variables have names of
 * the pool, so that the text of any cell is valid in them. A function block calls
 * another one and a function; there is no recursion.
 */
#include "tests/walker/words.h"

#include <stdio.h>
#include <string.h>

static const char types[] =
	"TYPE\n"
	"  Pair : STRUCT\n"
	"    d : DINT := -2147483640;\n"
	"    q : BOOL := TRUE;\n"
	"  END_STRUCT;\n"
	"  Rec : STRUCT\n"
	"    on : BOOL;\n"
	"    n : INT := 32765;\n"
	"    low : Pair;\n"
	"    t : TIME := T#15ms;\n"
	"    list : ARRAY[2..5] OF INT := [9, 2(-32768)];\n"
	"    name : STRING[9] := 'rec';\n"
	"  END_STRUCT;\n"
	"END_TYPE\n";

static const char *const head[RANDOM_POUS] = {
	[RANDOM_INNER] =
	"FUNCTION_BLOCK Inner LD\n"
	"VAR_INPUT\n  in_a : BOOL;\n  in_b : BOOL;\n  int_i : INT := 2;\n  usint_i : USINT;\nEND_VAR\n"
	"VAR_OUTPUT\n  out_a : BOOL;\n  int_b : INT := 2;\nEND_VAR\n"
	"VAR_IN_OUT\n  dint_a : DINT;\nEND_VAR\n"
	"VAR\n  bool_c : BOOL := TRUE;\n  sint_a : SINT := 127;\n  ton_a : TON;\n  ctu_a : CTU;\n"
	"  rec_a : Rec;\n  str_a : STRING[9] := 'ab';\n  real_a : REAL;\nEND_VAR\n"
	"VAR_TEMP\n  uint_b : UINT := 3;\n  bool_d : BOOL;\nEND_VAR\n",
	[RANDOM_OUTER] =
	"FUNCTION_BLOCK Holder LD\n"
	"VAR_INPUT\n  int_i : INT;\n  in_a : BOOL;\nEND_VAR\n"
	"VAR_OUTPUT\n  out_b : BOOL;\n  lint_a : LINT;\nEND_VAR\n"
	"VAR\n  inner_c : Inner;\n  recs : ARRAY[1..2] OF Rec;\n  dint_b : DINT := 1;\n  tof_a : TOF;\nEND_VAR\n"
	"VAR_TEMP\n  usint_b : USINT := 1;\nEND_VAR\n",
	[RANDOM_RECKON] =
	"FUNCTION Reckon : INT LD\n"
	"VAR_INPUT\n  int_i : INT;\n  in_a : BOOL;\n  usint_i : USINT := 2;\nEND_VAR\n"
	"VAR_OUTPUT\n  bool_c : BOOL;\nEND_VAR\n"
	"VAR_IN_OUT\n  dint_b : DINT;\nEND_VAR\n"
	"VAR\n  int_a : INT := 32766;\n  rec_a : Rec;\nEND_VAR\n",
};

static const char *const tail[RANDOM_POUS] = {
	[RANDOM_INNER] = "RUNG\n  | [ int_b := int_b + 1 ] | COIL out_a |\nEND_FUNCTION_BLOCK\n",
	[RANDOM_OUTER] = "END_FUNCTION_BLOCK\n",
	[RANDOM_RECKON] = "RUNG\n  | [ Reckon := int_a ] |\nEND_FUNCTION\n",
};

const char *random_own_head(int pou)
{
	return head[pou];
}

const char *random_own_tail(int pou)
{
	return tail[pou];
}

/* A parameter with a probability of @percent. */
static void maybe(struct builder *builder, uint32_t percent, const char *pin,
		  const char *type, bool write)
{
	struct random_source *source = builder->source;

	if (!random_chance(source, percent))
		return;
	if (!write && random_chance(source, 20))
		words_put(builder, " %s:=%s", pin, literal(source, type));
	else
		words_put(builder, " %s%s%s", pin, write ? "=>" : ":=",
		    variable(source, type, write));
}

static void call_inner(struct builder *builder, const char *instance)
{
	struct random_source *source = builder->source;

	words_put(builder, "Inner %s dint_a:=%s", instance, variable(source, "DINT", true));
	maybe(builder, 60, "int_i", "INT", false);
	maybe(builder, 40, "usint_i", "USINT", false);
	if (random_chance(source, 50))
		words_put(builder, " in_b:=%s%s", random_chance(source, 30) ? "/" : "",
		    operand(source, "BOOL", false));
	maybe(builder, 20, "out_a", "BOOL", true);
	maybe(builder, 20, "int_b", "INT", true);
}

static void call_outer(struct builder *builder)
{
	words_put(builder, "Holder outer_a");
	maybe(builder, 60, "int_i", "INT", false);
	maybe(builder, 20, "lint_a", "LINT", true);
}

static void call_reckon(struct builder *builder)
{
	struct random_source *source = builder->source;

	words_put(builder, "Reckon int_i:=%s in_a:=%s dint_b:=%s", variable(source, "INT", false),
	    operand(source, "BOOL", false), variable(source, "DINT", true));
	maybe(builder, 40, "usint_i", "USINT", false);
	maybe(builder, 30, "bool_c", "BOOL", true);
	maybe(builder, 60, "OUT", "INT", true);
}

void random_own_call(struct random_source *source, int pou, char *out, size_t size)
{
	struct builder builder = { source, out, size, 0 };
	uint32_t kind = random_below(source, 10);

	if (pou == RANDOM_INNER || kind < 3)
		call_reckon(&builder);
	else if (pou == RANDOM_OUTER)
		call_inner(&builder, "inner_c");
	else if (kind < 5)
		call_outer(&builder);
	else
		call_inner(&builder, kind < 8 ? "inner_a" : "inner_b");
}

/* A function has no state: no edges, and no instance. */
void random_without_memory(struct random_source *source, char *text, size_t size)
{
	struct builder builder = { source, text, size, 0 };
	static const char *const with[][2] = {
		{ "P ", "NO" }, { "N ", "NC" }, { "COILP ", "COIL" }, { "COILN ", "COIL" },
	};

	for (size_t i = 0; i < sizeof(with) / sizeof(*with); i++) {
		bool coil = i > 1;

		if (strncmp(text, with[i][0], strlen(with[i][0])) == 0)
			words_put(&builder, "%s %s", with[i][1],
			    variable(source, "BOOL", coil));
	}
}

void random_declare_own(struct builder *builder, const char *body)
{
	static const char *const own[][2] = {
		{ "rec_a", "Rec" }, { "recs", "ARRAY[1..3] OF Rec" },
		{ "inner_a", "Inner" }, { "inner_b", "Inner" }, { "outer_a", "Holder" },
	};

	for (size_t i = 0; i < sizeof(own) / sizeof(*own); i++)
		if (is_used(body, own[i][0]))
			words_put(builder, "  %s : %s;\n", own[i][0], own[i][1]);
}

const char *random_types(const char *body)
{
	return is_used(body, "rec_a") || is_used(body, "recs") ||
	       strstr(body, "FUNCTION") ? types : "";
}
