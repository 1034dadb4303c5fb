/* SPDX-License-Identifier: MIT
 *
 * test_init_form - initial values as a tree: defaults, what is written, and that random types
 * and values are read again as they were set, by the form and by the program that runs.
 */
#include "editor-gtk/document/init_form.h"
#include "editor-gtk/document/symbols.h"

#include "engine/trial/value.h"
#include "tests/tap.h"

static LadderDocument *opened(const char *text)
{
	LadderDocument *document = ladder_document_new();

	ladder_document_open_text(document, NULL, text, strlen(text), true);
	if (!ladder_document_project(document))
		printf("# %s\n# %s\n", text, ladder_document_diags(document) &&
		       ladder_document_diags(document)->count ?
		       ladder_document_diags(document)->diag[0].arg : "");
	return document;
}

/* The node at a path of names and elements: "Steps [1]"; "" the variable. */
static struct init_node *find(struct init_form *form, const char *path)
{
	struct init_node *node = init_form_root(form);
	char **names = g_strsplit(path, " ", -1);

	for (char **name = names; *name && **name && node; name++) {
		GPtrArray *parts = init_node_parts(form, node);

		node = NULL;
		for (guint i = 0; i < parts->len; i++)
			if (strcmp(((struct init_node *)parts->pdata[i])->name, *name) == 0)
				node = parts->pdata[i];
	}
	g_strfreev(names);
	return node;
}

static bool is_default(struct init_form *form, const char *path, const char *wanted)
{
	struct init_node *node = find(form, path);
	char *text = node ? init_node_default(form, node) : g_strdup("(none)");
	const bool is = strcmp(text, wanted) == 0;

	if (!is)
		printf("# %s: %s\n", path, text);
	g_free(text);
	return is;
}

static bool is_text(struct init_form *form, const char *path, const char *wanted)
{
	struct init_node *node = find(form, path);
	char *text = node ? init_node_text(form, node) : g_strdup("(none)");
	const bool is = strcmp(text, wanted) == 0;

	if (!is)
		printf("# %s: %s\n", path, text);
	g_free(text);
	return is;
}

static bool set(struct init_form *form, const char *path, const char *text)
{
	char *why = NULL;
	const bool good = init_node_set(form, find(form, path), text, &why);

	if (why)
		printf("# %s: %s\n", path, why);
	g_free(why);
	return good;
}

static const char PROGRAM[] =
	"RUNGBOARD 1\n\nTYPE\n"
	"  Bounds : STRUCT\n    Low  : INT := 10;\n    High : ARRAY[1..3] OF INT := [1, 2, 3];\n"
	"  END_STRUCT;\n"
	"  Recipe : STRUCT\n    Name  : STRING[5] := 'a';\n"
	"    Limit : Bounds := (Low := 5, High := [9]);\n    Wait  : TIME;\n    On    : BOOL;\n"
	"  END_STRUCT;\nEND_TYPE\n\n"
	"VAR\n  One   : Recipe := (Limit := (High := [1(), 16#4]));\n"
	"  Many  : ARRAY[-1..2] OF Recipe;\n  Plain : ARRAY[1..8] OF INT := [1, 2, 3(7), -5];\n"
	"  Delay : TON := (PT := T#3s);\n  Big   : ARRAY[0..99999] OF INT;\n  No : INT;\n"
	"  Reset : SR;\nEND_VAR\n\n"
	"PROGRAM Main LD\nRUNG\n  | COIL %QX0.0 |\nEND_PROGRAM\n";

static void test_defaults(LadderDocument *document)
{
	char *why;
	struct init_form *form = init_form_new(document, 0, 0, &why);

	if (!CHECK(form))
		return;
	CHECK(!init_form_is_changed(form));
	CHECK_AS(is_default(form, "Name", "'a'") && is_default(form, "Wait", "T#0s") &&
		 is_default(form, "On", "FALSE"), "the defaults are those of the members");
	CHECK_AS(is_default(form, "Limit Low", "5"),
		 "the default of the outer structure is used");
	CHECK(is_default(form, "Limit High [1]", "9") && is_default(form, "Limit High [2]", "2") &&
	      is_default(form, "Limit High [3]", "3"));
	CHECK_AS(is_text(form, "Limit High [2]", "16#4") && is_text(form, "Limit High [1]", ""),
		 "given values are shown as they are written");
	CHECK(is_text(form, "", "(Limit := (High := [1(), 16#4]))"));
	CHECK_AS(set(form, "Limit High [2]", "2") && is_text(form, "", ""),
		 "a value equal to its default is not written");
	CHECK(set(form, "Wait", "5s") && set(form, "Name", "'it$'s'") && set(form, "On", "TRUE") &&
	      set(form, "Limit Low", "16#05"));
	CHECK(is_text(form, "", "(Name := 'it$'s', Wait := T#5s, On := TRUE)"));
	CHECK_AS(!set(form, "On", "2") && !set(form, "Limit Low", "70000") &&
		 !set(form, "Wait", "x") && !set(form, "Name", "'sixsix'") &&
		 !set(form, "Limit Low", "1, 2") && !set(form, "Limit Low", "1) := 4"),
		 "values that do not fit are refused");
	CHECK(is_text(form, "", "(Name := 'it$'s', Wait := T#5s, On := TRUE)"));
	CHECK(set(form, "Wait", "") && set(form, "Name", "") && set(form, "On", " ") &&
	      is_text(form, "", "") && init_form_is_changed(form));
	init_form_free(form);
}

/* Constant expressions are shown as they are written, taken and refused. */
static void test_expressions(void)
{
	LadderDocument *document = opened("RUNGBOARD 1\n\nTYPE\n  Recipe : STRUCT\n"
		"    Speed : INT := Limit / 2;\n    Wait  : TIME := T#1s * Limit;\n"
		"    Steps : ARRAY[1..Limit] OF INT := [Limit, 2(Limit + 1)];\n  END_STRUCT;\nEND_TYPE\n\n"
		"VAR CONSTANT\n  Limit : INT := 4;\nEND_VAR\n\n"
		"VAR\n  One : Recipe := (Speed := Limit * 3);\nEND_VAR\n\n"
		"PROGRAM Main LD\nRUNG\n  | [ One.Speed > 1 ] | COIL %QX0.0 |\nEND_PROGRAM\n");
	char *why;
	struct init_form *form = init_form_new(document, 0, 1, &why);

	if (!CHECK(form))
		return;
	CHECK(is_text(form, "Speed", "Limit * 3") && is_default(form, "Speed", "Limit / 2"));
	CHECK(is_default(form, "Wait", "T#1s * Limit") && is_default(form, "Steps [3]", "Limit + 1") &&
	      is_default(form, "Steps [4]", "0"));
	CHECK(set(form, "Wait", "T#2s * (Limit - 1)") && set(form, "Steps [2]", "-Limit") &&
	      set(form, "Speed", "Limit"));
	CHECK(is_text(form, "", "(Speed := Limit, Wait := T#2s * (Limit - 1), Steps := [1(), -Limit])"));
	CHECK_AS(!set(form, "Speed", "Limit / 0") && !set(form, "Speed", "One") &&
		 !set(form, "Speed", "Lmit") && !set(form, "Speed", "T#1s * 2") &&
		 !set(form, "Speed", "Limit +") && !set(form, "Speed", "Limit * 10000"),
		 "expressions that fail are refused");
	CHECK(!init_node_set(form, find(form, "Speed"), "Limit / 0", &why) && why &&
	      strstr(why, "divides by 0"));
	g_free(why);
	init_form_free(form);
	g_object_unref(document);
}

/* Written counts stay as they are written, unless the run that they count changes. */
static void test_counts(void)
{
	LadderDocument *document = opened("RUNGBOARD 1\n\nTYPE\n  Recipe : STRUCT\n"
		"    Steps : ARRAY[1..4] OF INT;\n    Speed : INT;\n  END_STRUCT;\nEND_TYPE\n\n"
		"VAR CONSTANT\n  N : INT := 3;\nEND_VAR\n\n"
		"VAR\n  A : ARRAY[1..12] OF INT := [N(7), 2 * N(7), 5];\n"
		"  B : ARRAY[1..4] OF Recipe := [N - 1(Steps := [N(4)]), (Speed := 2)];\nEND_VAR\n\n"
		"PROGRAM Main LD\nRUNG\n  | [ A[1] > B[1].Speed ] | COIL %QX0.0 |\nEND_PROGRAM\n");
	char *why;
	struct init_form *form = init_form_new(document, 0, 1, &why);

	if (!CHECK(form))
		return;
	CHECK(is_text(form, "[9]", "7") && is_text(form, "[10]", "5") && is_text(form, "[11]", ""));
	CHECK_AS(is_text(form, "", "[N(7), 2 * N(7), 5]"), "nothing changed");
	CHECK(set(form, "[12]", "1") && is_text(form, "", "[N(7), 2 * N(7), 5, 0, 1]"));
	CHECK(set(form, "[2]", "8") && is_text(form, "", "[7, 8, 7, 2 * N(7), 5, 0, 1]"));
	CHECK(!init_node_set(form, find(form, ""), "[N - 3(1)]", &why) && strstr(why, "N - 3 = 0"));
	g_free(why);
	CHECK(!init_node_set(form, find(form, ""), "[5 * N(1)]", &why) &&
	      strstr(why, "5 * N = 15") && strstr(why, "12"));
	g_free(why);
	init_form_free(form);
	form = init_form_new(document, 0, 2, &why);
	CHECK(form && is_text(form, "", "[N - 1(Steps := [N(4)]), (Speed := 2)]"));
	CHECK(is_text(form, "[2] Steps [3]", "4") && set(form, "[3] Speed", "6") &&
	      is_text(form, "", "[N - 1(Steps := [N(4)]), (Speed := 6)]"));
	init_form_free(form);
	g_object_unref(document);
}

static void test_arrays(LadderDocument *document)
{
	char *why;
	struct init_form *form = init_form_new(document, 0, 1, &why);

	CHECK(set(form, "[0] On", "1") && set(form, "[1] On", "TRUE"));
	CHECK(is_text(form, "", "[1(), (On := 1), (On := TRUE)]"));
	CHECK(set(form, "[0] On", "TRUE") && is_text(form, "", "[1(), 2(On := TRUE)]"));
	CHECK(set(form, "[2] Limit High [3]", "4") &&
	      is_text(form, "", "[1(), 2(On := TRUE), (Limit := (High := [2(), 4]))]"));
	init_form_free(form);
	form = init_form_new(document, 0, 2, &why);
	CHECK(is_text(form, "[4]", "7") && is_text(form, "[7]", "") && is_default(form, "[7]", "0"));
	CHECK(is_text(form, "", "[1, 2, 3(7), -5]"));
	CHECK(set(form, "[2]", "") && set(form, "[8]", "1") &&
	      is_text(form, "", "[1, 0, 3(7), -5, 0, 1]"));
	init_form_free(form);
	form = init_form_new(document, 0, 3, &why);
	CHECK_AS(!find(form, "Q") && is_text(form, "PT", "T#3s") && is_default(form, "PT", "T#0s"),
		 "the form of an instance has its inputs");
	init_form_free(form);
	form = init_form_new(document, 0, 4, &why);
	CHECK_AS(init_node_parts(form, init_form_root(form))->len == 10,
		 "the form of a long array has ranges");
	CHECK(set(form, "[60000..69999] [65400..65499] [65432]", "1") &&
	      is_text(form, "", "[65432(0), 1]"));
	init_form_free(form);
	CHECK(!init_form_new(document, 0, 5, &why) && why);
	g_free(why);
}

/* ---- random types and values ---- */

struct made {
	GRand *random;
	GString *types;
	int structures;
};

static const char *const plain[] = { "INT", "BOOL", "TIME", "REAL", "STRING[4]", "WORD" };

static char *value_of(GRand *random, const char *type)
{
	static const char *const text[] = { "''", "'b'", "'$''", "'(b,]'" };
	const int n = g_rand_int_range(random, 0, 4);

	switch (*type) {
	case 'B': return g_strdup(n & 1 ? "TRUE" : "FALSE");
	case 'T': return g_strdup_printf("T#%ds", n);
	case 'R': return g_strdup_printf("%d.5", n);
	case 'S': return g_strdup(text[n]);
	case 'W': return g_strdup_printf(n ? "16#%X" : "%d", n);
	default: return g_strdup_printf("%d", n - 1);
	}
}

/* "ARRAY[-1..2] OF S1" or "INT"; @leaf: an elementary type, or NULL. */
static char *type_of(struct made *made, const char **leaf)
{
	const int n = g_rand_int_range(made->random, 0, 6 + made->structures);
	const int low = g_rand_int_range(made->random, -2, 2);
	const bool array = g_rand_boolean(made->random);
	char *word = n < 6 ? g_strdup(plain[n]) : g_strdup_printf("S%d", n - 6), *type;

	*leaf = n < 6 ? plain[n] : NULL;
	type = array ? g_strdup_printf("ARRAY[%d..%d] OF %s", low,
		low + g_rand_int_range(made->random, 0, 5), word) : g_strdup(word);
	g_free(word);
	return type;
}

static void make_structure(struct made *made)
{
	GString *text = g_string_new(NULL);
	const int members = g_rand_int_range(made->random, 1, 5);

	for (int i = 0; i < members; i++) {
		const char *leaf;
		char *type = type_of(made, &leaf);
		char *value = leaf && g_rand_boolean(made->random) ?
			value_of(made->random, leaf) : NULL;
		const bool array = g_str_has_prefix(type, "ARRAY");

		g_string_append_printf(text, "    M%d : %s%s%s%s%s;\n", i, type,
			value ? " := " : "", value && array ? "[" : "", value ? value : "",
			value && array ? "]" : "");
		g_free(value);
		g_free(type);
	}
	g_string_append_printf(made->types, "  S%d : STRUCT\n%s  END_STRUCT;\n",
			       made->structures++, text->str);
	g_string_free(text, TRUE);
}

/* Calls @act for every value below a node, with its path as a program has it. */
static void each(struct init_form *form, struct init_node *node, const char *path,
		 void (*act)(struct init_form *form, struct init_node *node, const char *path,
			     gpointer data), gpointer data)
{
	GPtrArray *parts = init_node_parts(form, node);

	if (!node->parts)
		act(form, node, path, data);
	for (guint i = 0; i < parts->len; i++) {
		struct init_node *part = parts->pdata[i];
		char *longer = g_strdup_printf("%s%s%s", path, *part->name == '[' ? "" : ".",
					       part->name);

		each(form, part, longer, act, data);
		g_free(longer);
	}
}

static void set_some(struct init_form *form, struct init_node *node, const char *path,
		     gpointer data)
{
	char *value = value_of(data, node->type), *why = NULL;

	(void)path;
	if (g_rand_int_range(data, 0, 3) == 0 && !init_node_set(form, node, value, &why))
		printf("# refused: %s %s %s\n", node->type, value, why);
	g_free(why);
	g_free(value);
}

/* "M1[2] = 5", a line each. */
static void note(struct init_form *form, struct init_node *node, const char *path, gpointer data)
{
	char *given = init_node_text(form, node), *otherwise = init_node_default(form, node);

	g_string_append_printf(data, "%s = %s\n", path, *given ? given : otherwise);
	g_free(given);
	g_free(otherwise);
}

static char *noted(struct init_form *form)
{
	GString *out = g_string_new(NULL);

	each(form, init_form_root(form), "V", note, out);
	return g_string_free(out, FALSE);
}

/* Has the program these values when it begins? */
static int differences(LadderDocument *document, const char *values)
{
	struct ladder *ladder = ladder_new();
	struct resource *resource = g_new0(struct resource, 1);
	char *text = ladder_document_text(document, NULL);
	char **lines = g_strsplit(values, "\n", -1);
	int bad = 0;

	void *memory = NULL;

	if (ladder_load_text(ladder, "", text, strlen(text)) && ladder_build(ladder)) {
		memory = g_malloc0(image_memory_size(ladder_program(ladder)));
		resource_init(resource, ladder_program(ladder), memory);
		resource_start(resource);
	} else {
		printf("# %s", text);
		bad = 1;
	}
	for (char **line = lines; !bad && *line && **line; line++) {
		char *wanted = strstr(*line, " = ");
		struct iec_text room;
		union iec_value value;
		struct location at;
		enum diag_id why;
		char shown[IEC_VALUE_TEXT], want[IEC_VALUE_TEXT];

		*wanted = '\0';
		at = value_find(&resource->image, *line, strlen(*line), &why);
		if (at.type == IEC_NONE ||
		    !value_parse(at.type, wanted + 3, strlen(wanted + 3), &room, &value, &why)) {
			bad++;
			printf("# %s\n", *line);
			continue;
		}
		iec_value_print(at.type, value, want, sizeof(want));
		iec_value_print(at.type, image_get(&resource->image, at), shown, sizeof(shown));
		if (strcmp(shown, want) != 0) {
			printf("# %s: %s, not %s\n", *line, shown, want);
			bad++;
		}
	}
	g_strfreev(lines);
	g_free(text);
	g_free(memory);
	ladder_free(ladder);
	g_free(resource);
	return bad;
}

/* A program with random types; its variable V gets random values. */
static int round_trip(guint32 seed)
{
	struct made made = { g_rand_new_with_seed(seed), g_string_new(NULL), 0 };
	LadderDocument *document;
	struct init_form *form;
	char *text, *type, *before, *values, *again, *written, *why = NULL;
	const char *leaf;
	int bad = 0;

	for (int i = g_rand_int_range(made.random, 1, 5); i > 0; i--)
		make_structure(&made);
	do
		type = type_of(&made, &leaf);
	while (leaf && !g_str_has_prefix(type, "ARRAY"));
	text = g_strdup_printf("RUNGBOARD 1\n\nTYPE\n%sEND_TYPE\n\nVAR\n  V : %s;\nEND_VAR\n\n"
		"PROGRAM Main LD\nRUNG\n  | COIL %%QX0.0 |\nEND_PROGRAM\n", made.types->str, type);
	document = opened(text);
	before = ladder_document_text(document, NULL);
	form = init_form_new(document, 0, 0, &why);
	for (int i = 0; form && i < 3; i++) {
		each(form, init_form_root(form), "V", set_some, made.random);
		values = noted(form);
		written = init_node_text(form, init_form_root(form));
		init_form_free(form);
		if (!symbol_set(document, 0, 0, FIELD_INITIAL, written, &why)) {
			printf("# %s: %s\n# %s\n", written, why, text);
			bad++;
		}
		form = init_form_new(document, 0, 0, &why);
		again = form ? noted(form) : g_strdup(why);
		if (strcmp(values, again) != 0) {
			printf("# seed %u\n%s\n# written %s\n# was\n%s# is\n%s", seed, text, written,
			       values, again);
			bad++;
		}
		bad += differences(document, values);
		g_free(again);
		g_free(written);
		g_free(values);
	}
	init_form_free(form);
	while (ladder_document_undo(document))
		;
	text = (g_free(text), ladder_document_text(document, NULL));
	bad += strcmp(text, before) != 0;
	g_object_unref(document);
	g_free(before);
	g_free(text);
	g_free(type);
	g_string_free(made.types, TRUE);
	g_rand_free(made.random);
	return bad;
}

int main(void)
{
	LadderDocument *document = opened(PROGRAM);
	int bad = 0;

	CHECK(ladder_document_project(document));
	test_defaults(document);
	test_arrays(document);
	test_expressions();
	test_counts();
	g_object_unref(document);
	for (guint32 seed = 1; seed <= 400 && bad < 3; seed++)
		bad += round_trip(seed);
	CHECK_AS(bad == 0,
		 "values of random types are read as they were set, and the program starts with them");
	return tap_done();
}
