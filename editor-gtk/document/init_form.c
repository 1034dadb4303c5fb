/* SPDX-License-Identifier: MIT
 *
 * init_form - initial values as a tree; see init_form.h.
 *
 * A value is known by its offset in the memory of the variable: the engine gives the offset
 * of each constant in a text (model/init.h) and of each part of a type (model/shape.h).
 */
#include "editor-gtk/document/init_form.h"

#include "editor-gtk/document/symbols.h"
#include "editor-gtk/draw/listing.h"
#include "editor-gtk/edit/entry_operand.h"
#include "editor-gtk/kit/diag_said.h"
#include "editor-gtk/kit/i18n.h"

#include "engine/model/init.h"
#include "engine/model/shape.h"
#include "engine/xref/xref.h"

#include <string.h>

#define GROUP       100    /* parts of a node, at most, if it has elements     */
#define VALUES_MOST 100000 /* that a form can show                             */

struct init_detail {
	struct init_node node;
	struct init_detail *parent;
	struct word_pin pin;      /* its type; of a range that of its array     */
	uint32_t offset;          /* from the start of the variable             */
	uint32_t first, count;    /* an array or a range: its elements           */
	bool elements;            /* its parts are elements or ranges            */
	GHashTable *declared;     /* values by the declaration of this member, by the offset
				     from here; NULL: none                      */
	GPtrArray *parts;         /* NULL: not asked for yet                     */
};

struct init_form {
	struct ladder *ladder;
	struct project *project;
	struct arena scratch;
	struct init_detail *root;
	GHashTable *given;        /* offset to text                              */
	GArray *sorted;           /* the offsets in @given, in order              */
	int table;                /* of the declaration whose values are read     */
	struct diag_list *diags;  /* of its expressions                           */
	struct init_walk *walk;   /* the walk that calls fold()                    */
	bool keeps;               /* it walks the text that is written now         */
	GHashTable *counts;       /* of struct written_count, by count_key(): those in that text
				     that are no plain number                     */
	bool changed;
};

/* The n of n( … ) as it is written, such as 2 * Motors. */
struct written_count {
	char *text;
	uint32_t count;
};

/* ---- what a type is ---- */

static const struct word_row *row_of(const struct init_form *form, const struct word_pin *pin)
{
	return words_row(&form->project->words, (enum word)pin->word);
}

static bool may_be_given(const struct word_row *row, const struct word_pin *pin)
{
	return *pin->name && (row->kind == WORD_STRUCT || pin->dir == PIN_IN);
}

bool init_form_has(const struct project *project, const struct var *var)
{
	const struct word_row *row;

	if (var->array.count)
		return true;
	if (var->type != IEC_NONE)
		return false;
	row = words_row(&project->words, var->fb);
	for (int i = 0; i < row->pin_count; i++)
		if (may_be_given(row, &row->pin[i]))
			return true;
	return false;
}

static char *type_of(const struct init_form *form, const struct word_pin *pin)
{
	struct var var = { .type = pin->type, .array = { pin->elements ? pin->low : 0,
							 pin->elements } };

	if (pin->type == IEC_NONE)
		var.fb = (enum word)pin->word;
	else
		var.capacity = pin->capacity;
	return listing_type(form->project, &var);
}

/* ---- texts ---- */

static void count_free(gpointer data)
{
	struct written_count *count = data;

	g_free(count->text);
	g_free(count);
}

/* An array in an array may begin at the same offset: the size of an element tells them apart. */
static char *count_key(uint32_t offset, uint32_t unit)
{
	return g_strdup_printf("%u %u", offset, unit);
}

/* Keeps the text of a count, for the time when it is written again. */
static void keep_count(struct init_form *form, const char *text, size_t len, int64_t count)
{
	const struct init_level *level = &form->walk->level[form->walk->depth - 1];
	struct written_count *kept;

	if (!form->keeps || count < 1 || count > G_MAXINT32)
		return;
	kept = g_new(struct written_count, 1);
	*kept = (struct written_count){ g_strndup(text, len), (uint32_t)count };
	g_hash_table_insert(form->counts, count_key(level->base + level->element * level->unit,
						    level->unit), kept);
}

static enum diag_id fold(void *context, const char *text, size_t len, struct init_value *out)
{
	struct init_form *form = context;
	const bool count = out->type == IEC_NONE;

	diag_init(form->diags);
	if (!ladder_constant(form->ladder, form->table, text, len, out, form->diags))
		return form->diags->count ? form->diags->diag[0].id : DIAG_NO_MEMORY;
	if (count)
		keep_count(form, text, len, out->value.i);
	return DIAG_COUNT;
}

static struct init_fold fold_of(struct init_form *form)
{
	return (struct init_fold){ fold, form, &form->project->words };
}

/* What is wrong in a walk, as a message takes it. */
static char *what_of(const struct init_walk *walk)
{
	char said[LIMIT_ARG];

	init_say(walk, said, sizeof(said));
	return g_strdup(said);
}

/* Adds the values of an initial text. False: it is wrong, or has too many values. */
static bool take_values(struct init_form *form, const struct word_pin *pin, const char *text,
			GHashTable *values, enum diag_id *why, char **what)
{
	struct var var = { .type = pin->type, .has_init = true,
			   .array = { pin->elements ? pin->low : 0, pin->elements } };
	struct init_walk *walk = g_new(struct init_walk, 1);
	struct init_value value;
	int count = 0;

	if (pin->type == IEC_NONE)
		var.fb = (enum word)pin->word;
	else
		var.capacity = pin->capacity;
	var.init_text = names_intern(&form->project->names, text, strlen(text));
	diag_init(form->diags);
	form->walk = walk;
	form->keeps = values == form->given;
	init_begin(walk, form->project, &var, &form->scratch);
	walk->fold = fold_of(form);
	while (init_next(walk, &value))
		count++;
	*why = walk->why;
	*what = form->diags->count ? g_strdup(form->diags->diag[0].arg) :
				     what_of(walk);
	if (walk->why == DIAG_COUNT) {
		init_begin(walk, form->project, &var, NULL);
		walk->fold = fold_of(form);
		for (count = 0; init_next(walk, &value) && count <= VALUES_MOST; count++)
			g_hash_table_insert(values, GUINT_TO_POINTER(value.offset),
					    g_strndup(walk->from, (gsize)(walk->behind - walk->from)));
	}
	form->walk = NULL;
	g_free(walk);
	return *why == DIAG_COUNT && count <= VALUES_MOST;
}

static GHashTable *values_new(void)
{
	return g_hash_table_new_full(NULL, NULL, NULL, g_free);
}

/* The values that the declaration of a member of @word gives; NULL: none. */
static GHashTable *declared_values(struct init_form *form, enum word word,
				   const struct var *var, const struct word_pin *pin)
{
	const struct word_row *row = words_row(&form->project->words, word);
	const int table = form->table;
	GHashTable *values;
	char *text, *what;
	enum diag_id why;

	if (!var || !var->has_init)
		return NULL;
	values = values_new();
	text = symbol_initial(form->project, var);
	form->table = 1 + row->owner + (row->kind == WORD_STRUCT ? form->project->pou_count : 0);
	take_values(form, pin, text, values, &why, &what);
	form->table = table;
	g_free(what);
	g_free(text);
	return values;
}

/* The same of a pin of the catalogue, which is no array. */
static GHashTable *catalogue_values(const struct word_pin *pin)
{
	GHashTable *values;
	char text[64];

	if (!pin->has_init)
		return NULL;
	values = values_new();
	literal_print(pin->type, pin_init(pin), text, sizeof(text));
	g_hash_table_insert(values, GUINT_TO_POINTER(0), g_strdup(text));
	return values;
}

static char *zero_of(enum iec_type type)
{
	char text[64];

	if (type == IEC_STRING)
		return g_strdup("''");
	literal_print(type, (union iec_value){ .i = 0 }, text, sizeof(text));
	return g_strdup(text);
}

/* ---- nodes ---- */

static void detail_free(gpointer data)
{
	struct init_detail *detail = data;

	g_clear_pointer(&detail->declared, g_hash_table_unref);
	g_clear_pointer(&detail->parts, g_ptr_array_unref);
	g_free(detail->node.name);
	g_free(detail->node.type);
	g_free(detail);
}

/* @name: taken over. */
static struct init_detail *detail_new(struct init_form *form, struct init_detail *parent,
				      char *name, struct word_pin pin, uint32_t offset)
{
	struct init_detail *detail = g_new0(struct init_detail, 1);

	detail->parent = parent;
	detail->pin = pin;
	detail->offset = offset;
	detail->count = pin.elements;
	detail->elements = pin.elements > 0;
	detail->node = (struct init_node){ name, type_of(form, &pin),
					   pin.elements || pin.type == IEC_NONE, detail };
	return detail;
}

static struct word_pin element_of(const struct init_detail *detail)
{
	struct word_pin pin = detail->pin;

	pin.elements = 0;
	return pin;
}

static uint32_t unit_of(const struct init_form *form, const struct init_detail *detail)
{
	return shape_of(&form->project->words, &detail->pin).unit;
}

static struct init_detail *range_new(struct init_form *form, struct init_detail *parent,
				     uint32_t first, uint32_t count)
{
	const long long low = parent->pin.low;
	struct init_detail *range = detail_new(form, parent, g_strdup_printf("[%lld..%lld]",
		low + first, low + first + count - 1), parent->pin, parent->offset +
		(first - parent->first) * unit_of(form, parent));

	range->first = first;
	range->count = count;
	g_free(range->node.type);
	range->node.type = g_strdup("");
	return range;
}

static void add_elements(struct init_form *form, struct init_detail *detail)
{
	const uint32_t unit = unit_of(form, detail), end = detail->first + detail->count;
	uint32_t step = 1;

	while (detail->count > step * GROUP)
		step *= GROUP;
	for (uint32_t i = detail->first; i < end; i += step) {
		const uint32_t offset = detail->offset + (i - detail->first) * unit;

		g_ptr_array_add(detail->parts, step > 1 ?
			range_new(form, detail, i, MIN(step, end - i)) :
			detail_new(form, detail, g_strdup_printf("[%lld]",
				(long long)detail->pin.low + i), element_of(detail), offset));
	}
}

static void add_members(struct init_form *form, struct init_detail *detail)
{
	const struct word_row *row = row_of(form, &detail->pin);
	const struct var_table *vars = shape_vars(form->project, (enum word)detail->pin.word);

	for (int i = 0; i < row->pin_count; i++) {
		struct word_pin pin = row->pin[i];
		struct init_detail *part;

		if (!may_be_given(row, &pin))
			continue;
		if (!vars) { /* a built-in block: its pins have no arrays */
			pin.elements = 0;
			pin.capacity = IEC_STRING_DEFAULT;
		}
		part = detail_new(form, detail, g_strdup(pin.name), pin,
				  detail->offset + pin.offset);
		part->declared = vars ? declared_values(form, (enum word)detail->pin.word,
							       &vars->var[i], &pin) :
				 catalogue_values(&row->pin[i]);
		g_ptr_array_add(detail->parts, part);
	}
}

GPtrArray *init_node_parts(struct init_form *form, struct init_node *node)
{
	struct init_detail *detail = node->detail;

	if (detail->parts)
		return detail->parts;
	detail->parts = g_ptr_array_new_with_free_func(detail_free);
	if (detail->elements)
		add_elements(form, detail);
	else if (node->parts)
		add_members(form, detail);
	return detail->parts;
}

/* ---- values ---- */

/* The outermost declaration with a value counts. NULL: none has one. */
static const char *declared_text(const struct init_detail *detail)
{
	const char *text = NULL, *outer;

	for (const struct init_detail *at = detail; at; at = at->parent) {
		outer = at->declared ? g_hash_table_lookup(at->declared,
			GUINT_TO_POINTER(detail->offset - at->offset)) : NULL;
		text = outer ? outer : text;
	}
	return text;
}

static char *default_of(const struct init_detail *detail)
{
	const char *text = declared_text(detail);

	return text ? g_strdup(text) : zero_of(detail->pin.type);
}

char *init_node_default(struct init_form *form, struct init_node *node)
{
	(void)form;
	return node->parts ? g_strdup("") : default_of(node->detail);
}

/* Have both texts the same value? */
static bool is_same(enum iec_type type, const char *a, const char *b)
{
	struct literal one, other;
	union iec_value x, y;

	if (strcmp(a, b) == 0)
		return true;
	if (type == IEC_STRING || literal_parse(a, strlen(a), &one) != LITERAL_OK ||
	    literal_parse(b, strlen(b), &other) != LITERAL_OK ||
	    !literal_fit(&one, type, &x) || !literal_fit(&other, type, &y))
		return false;
	return iec_type_row(type)->class & CLASS_REAL ? x.r == y.r : x.i == y.i;
}

static gint by_offset(gconstpointer a, gconstpointer b)
{
	const guint32 x = *(const guint32 *)a, y = *(const guint32 *)b;

	return x < y ? -1 : x > y;
}

static void sort_given(struct init_form *form)
{
	GHashTableIter iter;
	gpointer key;

	g_array_set_size(form->sorted, 0);
	g_hash_table_iter_init(&iter, form->given);
	while (g_hash_table_iter_next(&iter, &key, NULL)) {
		const guint32 offset = GPOINTER_TO_UINT(key);

		g_array_append_val(form->sorted, offset);
	}
	g_array_sort(form->sorted, by_offset);
}

/* The last given offset before @end; -1: none from @from on. */
static gint64 last_given(const struct init_form *form, uint64_t from, uint64_t end)
{
	guint low = 0, high = form->sorted->len;

	while (low < high) {
		const guint middle = (low + high) / 2;

		if (g_array_index(form->sorted, guint32, middle) < end)
			low = middle + 1;
		else
			high = middle;
	}
	return low && g_array_index(form->sorted, guint32, low - 1) >= from ?
	       (gint64)g_array_index(form->sorted, guint32, low - 1) : -1;
}

/* ---- writing ---- */

static void write_node(struct init_form *form, struct init_detail *detail, GString *out);

static void write_members(struct init_form *form, struct init_detail *detail, GString *out)
{
	GPtrArray *parts = init_node_parts(form, &detail->node);
	const gsize start = out->len;

	for (guint i = 0; i < parts->len; i++) {
		struct init_detail *part = parts->pdata[i];
		const gsize before = out->len;

		g_string_append_printf(out, "%s%s := ", before == start ? "(" : ", ",
				       part->node.name);
		const gsize value = out->len;

		write_node(form, part, out);
		if (out->len == value)
			g_string_truncate(out, before);
	}
	if (out->len > start)
		g_string_append_c(out, ')');
}

/* Is there a declaration that gives values to the elements? */
static bool is_declared(const struct init_detail *detail)
{
	for (; detail; detail = detail->parent)
		if (detail->declared)
			return true;
	return false;
}

/* Equal elements one after another. */
struct run {
	char *text;                       /* of each; "": it keeps its value; NULL: no run */
	uint32_t count;
	const struct written_count *kept; /* at the first of them; NULL: none        */
};

static void write_run(const struct init_detail *array, const struct run *run, GString *out)
{
	const bool named = run->kept && run->kept->count == run->count;
	const char *text = run->text;
	const bool plain = !*text && array->pin.type != IEC_NONE && !is_declared(array);
	char *zero = plain ? zero_of(array->pin.type) : NULL;
	const char *value = plain ? zero : text;
	const gsize len = strlen(value);
	char *count = named ? g_strdup(run->kept->text) : g_strdup_printf("%u", run->count);

	g_string_append(out, out->str[out->len - 1] == '[' ? "" : ", ");
	if (run->count == 1 && !named && *value)
		g_string_append(out, value);
	else if (*value == '(') /* 2(Speed := 7) is short for 2((Speed := 7)) */
		g_string_append_printf(out, "%s(%.*s)", count, (int)len - 2, value + 1);
	else
		g_string_append_printf(out, "%s(%s)", count, value);
	g_free(count);
	g_free(zero);
}

/* Writes element @number of an array, which may not have been made as a node yet. */
static char *element_text(struct init_form *form, struct init_detail *array, uint32_t number,
			  uint32_t unit)
{
	const uint32_t offset = array->offset + number * unit;
	struct init_detail *element;
	GString *out;

	if (last_given(form, offset, (uint64_t)offset + unit) < 0)
		return g_strdup("");
	out = g_string_new(NULL);
	element = detail_new(form, array, NULL, element_of(array), offset);
	write_node(form, element, out);
	detail_free(element);
	return g_string_free(out, FALSE);
}

static void write_elements(struct init_form *form, struct init_detail *array, GString *out)
{
	const uint32_t unit = unit_of(form, array);
	const gint64 last = last_given(form, array->offset,
				       array->offset + (uint64_t)unit * array->count);
	const uint32_t end = last < 0 ? 0 : ((uint32_t)last - array->offset) / unit + 1;
	GString *list = g_string_new("[");
	struct run run = { NULL, 0, NULL };

	for (uint32_t i = 0; i < end; i++) {
		char *key = count_key(array->offset + i * unit, unit);
		const struct written_count *kept = g_hash_table_lookup(form->counts, key);
		char *text = element_text(form, array, i, unit);

		g_free(key);
		/* A run with a written count has that many elements. */
		if (run.text && !kept && strcmp(run.text, text) == 0 &&
		    !(run.kept && run.count == run.kept->count)) {
			run.count++;
			g_free(text);
			continue;
		}
		if (run.text)
			write_run(array, &run, list);
		g_free(run.text);
		run = (struct run){ text, 1, kept };
	}
	if (run.text && *run.text)
		write_run(array, &run, list);
	g_free(run.text);
	if (list->len > 1 && list->str[list->len - 1] != '[') {
		g_string_append(out, list->str);
		g_string_append_c(out, ']');
	}
	g_string_free(list, TRUE);
}

static void write_value(struct init_form *form, struct init_detail *detail, GString *out)
{
	const char *text = g_hash_table_lookup(form->given, GUINT_TO_POINTER(detail->offset));
	char *otherwise;

	if (!text)
		return;
	otherwise = default_of(detail);
	if (!is_same(detail->pin.type, text, otherwise))
		g_string_append(out, text);
	g_free(otherwise);
}

/* Writes nothing if all values are the defaults. */
static void write_node(struct init_form *form, struct init_detail *detail, GString *out)
{
	if (detail->elements)
		write_elements(form, detail, out);
	else if (detail->node.parts)
		write_members(form, detail, out);
	else
		write_value(form, detail, out);
}

char *init_node_text(struct init_form *form, struct init_node *node)
{
	GString *out;
	const char *text;

	if (!node->parts) {
		text = g_hash_table_lookup(form->given, GUINT_TO_POINTER(node->detail->offset));
		return g_strdup(text ? text : "");
	}
	out = g_string_new(NULL);
	write_node(form, node->detail, out);
	return g_string_free(out, FALSE);
}

/* ---- setting ---- */

/* Is a text longer than its STRING? */
static bool is_long(const struct word_pin *pin, const char *text)
{
	char bytes[IEC_STRING_MOST];
	struct literal literal;

	return pin->type == IEC_STRING &&
	       literal_parse(text, strlen(text), &literal) == LITERAL_OK &&
	       literal_string(&literal, bytes) > (pin->capacity ? pin->capacity :
						  IEC_STRING_MOST);
}

/* A mistake in the form of a text, not in its values. */
static bool is_form(enum diag_id fault)
{
	return fault == DIAG_EXPECTED || fault == DIAG_SIGN_MISSING || fault == DIAG_SYNTAX;
}

static bool fits(struct init_form *form, const struct init_detail *detail, const char *text,
		 char **why)
{
	GHashTable *values = values_new();
	enum diag_id fault;
	char *what;
	const bool good = take_values(form, &detail->pin, text, values, &fault, &what);

	if (!good)
		*why = is_form(fault) ? diag_said_of(DIAG_BAD_LITERAL, text) :
					diag_said_of(fault, what);
	g_hash_table_unref(values);
	g_free(what);
	if (good && is_long(&detail->pin, text)) {
		*why = g_strdup_printf(_("It is longer than %d bytes"), detail->pin.capacity);
		return false;
	}
	return good;
}

bool init_node_set(struct init_form *form, struct init_node *node, const char *text,
		   char **why)
{
	struct init_detail *detail = node->detail;
	char *clean = g_strstrip(g_strdup(text));
	const gsize size = strlen(clean) + sizeof("T#");
	char *typed = g_malloc0(size);
	bool room, good = true;

	if (!entry_literal(clean, strlen(clean), typed, size, &room))
		g_strlcpy(typed, clean, size);
	if (*typed && !fits(form, detail, typed, why)) {
		good = false;
	} else {
		if (*typed)
			g_hash_table_insert(form->given, GUINT_TO_POINTER(detail->offset),
					    g_strdup(typed));
		else
			g_hash_table_remove(form->given, GUINT_TO_POINTER(detail->offset));
		sort_given(form);
		form->changed = true;
	}
	g_free(typed);
	g_free(clean);
	return good;
}

bool init_form_is_changed(const struct init_form *form)
{
	return form->changed;
}

struct init_node *init_form_root(struct init_form *form)
{
	return &form->root->node;
}

/* ---- life ---- */

static bool load(struct init_form *form, LadderDocument *document)
{
	gsize len;
	char *text = ladder_document_outline(document, &len, NULL, NULL);
	bool good = text && ladder_load_text(form->ladder, g_intern_string(ladder_document_file(document)),
					     text, len);

	g_free(text);
	form->project = good ? ladder_project(form->ladder) : NULL;
	return good && form->project;
}

/* Reads the values that are written now. */
static bool begin(struct init_form *form, int table, int index, char **why)
{
	const struct var_table *vars = xref_table(form->project, table);
	const struct var *var = vars && index < vars->count ? &vars->var[index] : NULL;
	enum diag_id fault = DIAG_COUNT;
	char *text, *what = NULL;
	bool good;

	if (!var || !init_form_has(form->project, var)) {
		*why = g_strdup(_("It has no parts"));
		return false;
	}
	form->table = table;
	form->root = detail_new(form, NULL, g_strdup(project_text(form->project, var->name)),
				shape_pin(var), 0);
	text = var->has_init ? symbol_initial(form->project, var) : g_strdup("");
	good = !*text || take_values(form, &form->root->pin, text, form->given, &fault, &what);
	if (!good)
		*why = fault == DIAG_COUNT ? g_strdup(_("It has too many values for a form")) :
		       diag_said_of(fault, what);
	sort_given(form);
	g_free(what);
	g_free(text);
	return good;
}

struct init_form *init_form_new(LadderDocument *document, int table, int index, char **why)
{
	struct init_form *form = g_new0(struct init_form, 1);

	*why = NULL;
	form->ladder = ladder_document_reader(document);
	arena_init(&form->scratch);
	form->diags = g_new(struct diag_list, 1);
	form->given = values_new();
	form->counts = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, count_free);
	form->sorted = g_array_new(FALSE, FALSE, sizeof(guint32));
	if (!load(form, document))
		*why = g_strdup(_("The file cannot be read as a program. Correct its errors first"));
	else if (begin(form, table, index, why))
		return form;
	init_form_free(form);
	return NULL;
}

void init_form_free(struct init_form *form)
{
	if (!form)
		return;
	if (form->root)
		detail_free(form->root);
	g_array_unref(form->sorted);
	g_hash_table_unref(form->given);
	g_hash_table_unref(form->counts);
	arena_free(&form->scratch);
	g_free(form->diags);
	ladder_free(form->ladder);
	g_free(form);
}
