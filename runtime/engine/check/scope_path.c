/* SPDX-License-Identifier: MIT
 *
 * scope_path - operands with dots and brackets: pins, members, elements.
 *
 * A path goes from a declared name inwards, a step a dot or index. Some indices may be
 * found out in the scan: whatever is behind one lies at the same place of each
 * element. It remembers nothing.
 */
#include "engine/check/scope_mean.h"

#include "engine/model/shape.h"

#include <stdio.h>
#include <string.h>

/* On the way along a path. */
struct path {
	struct scope *scope;
	uint32_t table;
	const char *at, *end;
	struct meaning m;        /* what was reached                          */
	int pin;                 /* the first part that was named; -1: none   */
	struct open_index *open; /* LIMIT_INDICES of those to be found out    */
	int opens;
	const struct meaning *index_of;
	enum diag_id why;
};

static bool refuse(struct path *path, enum diag_id why)
{
	path->why = why;
	return false;
}

static void skip_blanks(struct path *path)
{
	while (path->at < path->end && *path->at == ' ')
		path->at++;
}

/* The text up to the next @stops, without the blanks at its ends; the path goes to
 * the character that stopped it. */
static size_t take(struct path *path, const char *stops, const char **text)
{
	size_t len;

	skip_blanks(path);
	*text = path->at;
	while (path->at < path->end && !strchr(stops, *path->at))
		path->at++;
	len = (size_t)(path->at - *text);
	while (len && (*text)[len - 1] == ' ')
		len--;
	return len;
}

static bool has_parts(const struct meaning *m)
{
	return m->kind == MEANING_INSTANCE || m->kind == MEANING_STRUCT;
}

/* A part that @pin declares. */
static void mean_pin(const struct scope *scope, const struct word_pin *pin,
		     struct meaning *m)
{
	m->offset += pin->offset;
	m->type = pin->type;
	m->array = pin_array(pin);
	if (pin->elements) {
		m->kind = MEANING_ARRAY;
		m->word = pin->type == IEC_NONE ? pin->word : 0;
		m->capacity = pin->type == IEC_NONE ? 0 : pin->capacity;
		m->stride = shape_of(&scope_project(scope)->words, pin).unit;
	} else if (pin->type == IEC_NONE) {
		scope_mean_whole(scope, pin->word, m);
	} else {
		m->kind = MEANING_PIN;
	}
}

/* `.Speed`. What is inside a block is not to be named from outside. */
static bool step_into(struct path *path)
{
	struct meaning *m = &path->m;
	const struct word_row *row;
	const char *name;
	size_t len;
	int index;

	path->at++;
	len = take(path, ".[", &name);
	if (!has_parts(m)) /* the name itself has no dots behind it */
		return refuse(path, m->kind == MEANING_VARIABLE ?
				    DIAG_UNKNOWN_NAME : DIAG_NO_PIN);
	row = scope_row(path->scope, m->word);
	index = word_pin_find(row, name, len);
	if (index < 0)
		return refuse(path, DIAG_NO_PIN);
	if (path->pin < 0)
		path->pin = index;
	if (row->kind == WORD_FB)
		m->writable = row->pin[index].dir == PIN_IN;
	mean_pin(path->scope, &row->pin[index], m);
	return true;
}

/* ---- indices ---- */

/* An element whose number is known, or the first of those that are possible. */
static void mean_element(struct path *path, uint32_t number)
{
	struct meaning *m = &path->m;

	if (m->addr.area != AREA_NONE)
		m->addr = vars_shift(m->addr, number);
	if (m->var)
		m->offset += number * m->stride;
	m->array.count = 0;
	m->kind = m->var ? MEANING_ELEMENT : MEANING_ADDRESS;
	if (m->var && m->type == IEC_NONE)
		scope_mean_whole(path->scope, m->word, m);
}

/* A fixed index, whose type may have values above INT64_MAX. */
static bool step_fixed(struct path *path, enum iec_type type, int64_t index)
{
	int64_t number = var_element(path->m.array, index);
	bool is_signed = type == IEC_NONE ||
			 iec_type_row(type)->class == CLASS_SIGNED;

	if (number < 0 || (!is_signed && index < 0))
		return refuse(path, DIAG_INDEX_RANGE);
	mean_element(path, (uint32_t)number);
	return true;
}

static bool step_open(struct path *path, const struct meaning *index)
{
	if (path->opens == LIMIT_INDICES)
		return refuse(path, DIAG_INDEX_PLAIN);
	if (!path->opens)
		path->index_of = index;
	path->open[path->opens++] = (struct open_index){
		path->m.array, path->m.stride, index,
	};
	mean_element(path, 0);
	return true;
}

static bool is_index(enum iec_type type)
{
	return iec_type_row(type)->class & (ANY_INT | CLASS_BITS);
}

static const struct pou *pou_of(const struct scope *scope, uint32_t table)
{
	return table ? &scope_project(scope)->pou[table - 1] : NULL;
}

/* Index @text: an integer constant, or an operand that holds one. */
static bool step_index(struct path *path, const char *text, size_t len)
{
	struct names *names = &scope_project(path->scope)->names;
	const struct meaning *m = scope_find(path->scope,
		pou_of(path->scope, path->table),
		names_intern(names, text, len), &path->why);
	bool literal = m && m->kind == MEANING_LITERAL;

	if (!m)
		return false;
	if (literal && m->literal.high)
		return refuse(path, DIAG_INDEX_RANGE);
	if (literal && (m->literal.real ||
			(m->type != IEC_NONE && !is_index(m->type))))
		return refuse(path, DIAG_INDEX_TYPE);
	if (literal)
		return step_fixed(path, m->type, m->literal.value.i);
	if (meaning_fault(m) != DIAG_COUNT || !is_index(m->type))
		return refuse(path, DIAG_INDEX_TYPE);
	if (m->kind == MEANING_VARIABLE && m->constant && m->var->has_init) {
		if (!path->opens)
			path->index_of = m;
		return step_fixed(path, m->type, m->var->init.i);
	}
	return step_open(path, m);
}

/* `[3]`, `[ i ]`. */
static bool step_element(struct path *path)
{
	const char *text;
	size_t len;

	path->at++;
	len = take(path, "[]", &text);
	if (!len || path->at == path->end || *path->at != ']')
		return refuse(path, DIAG_UNKNOWN_NAME);
	path->at++;
	if (path->m.kind != MEANING_ARRAY)
		return refuse(path, DIAG_NOT_ARRAY);
	return step_index(path, text, len);
}

/* ---- paths ---- */

/* An address before [ is an array up to the end of its area. */
static bool begin_address(struct path *path, const char *text, size_t len)
{
	const struct areas *areas = scope_areas(path->scope);
	struct meaning *m = &path->m;
	uint32_t first;

	if (!scope_mean_address(path->scope, text, len, m, &path->why))
		return false;
	first = m->addr.byte * 8 + m->addr.bit;
	m->array.count = (areas->bytes[m->addr.area] * 8 - first) /
			 m->addr.bits;
	m->stride = iec_type_row(m->type)->size;
	m->kind = MEANING_ARRAY;
	return true;
}

static bool begin(struct path *path)
{
	const char *text;
	const char *start = path->at;
	size_t len = take(path, ".[", &text);

	if (!len || path->at == path->end)
		return false;
	if (scope_mean_name(path->scope, path->table, text, len, &path->m))
		return true;
	path->at = start;
	len = take(path, "[", &text); /* %MX0.0[3] */
	return path->at < path->end && begin_address(path, text, len);
}

/* What an open index leads to is no instance: that is called, and has a place. */
static bool finish(struct path *path, struct meaning *out)
{
	struct meaning *m = &path->m;

	m->index_of = path->index_of;
	if (path->opens) {
		if (m->kind == MEANING_INSTANCE)
			return refuse(path, DIAG_INDEX_PLAIN);
		if (!meaning_is_whole(m))
			m->kind = MEANING_ELEMENT;
		if (!scope_keep_open(path->scope, m, path->open, path->opens))
			return refuse(path, DIAG_NO_MEMORY);
	} else if (path->pin >= 0 && m->kind != MEANING_ARRAY) {
		m->pin = path->pin;
		if (m->kind == MEANING_ELEMENT)
			m->kind = MEANING_PIN;
	}
	*out = *m;
	return true;
}

bool scope_mean_path(struct scope *scope, uint32_t table, const char *text,
		     size_t len, struct meaning *out, enum diag_id *why)
{
	struct open_index open[LIMIT_INDICES];
	struct path path = { .scope = scope, .table = table, .at = text,
			     .end = text + len, .open = open, .pin = -1,
			     .why = *why };
	bool good = begin(&path);

	while (good && path.at < path.end) {
		skip_blanks(&path);
		if (path.at == path.end)
			break;
		good = *path.at == '.' ? step_into(&path) :
		       *path.at == '[' ? step_element(&path) :
					 refuse(&path, DIAG_UNKNOWN_NAME);
	}
	good = good && finish(&path, out);
	*why = path.why;
	return good;
}

/* Not in a text: 'a[1]'. */
bool scope_has_index(const char *text, size_t len)
{
	return memchr(text, '[', len) && !memchr(text, '\'', len);
}

const struct meaning *scope_index(struct scope *scope, const struct pou *pou,
				  uint32_t text, size_t *at)
{
	struct project *project = scope_project(scope);
	const char *all = scope_text(scope, text);
	const char *open = strchr(all + *at, '[');
	struct path path = { .scope = scope };
	const char *index;
	enum diag_id why;
	size_t len;

	if (!open)
		return NULL;
	path.at = open + 1;
	path.end = open + strlen(open);
	len = take(&path, "]", &index);
	*at = (size_t)(path.at - all);
	return scope_find(scope, pou, names_intern(&project->names, index, len),
			  &why);
}

uint32_t scope_first(struct scope *scope, const struct pou *pou, uint32_t array,
		     const char *tail, size_t len)
{
	struct names *names = &scope_project(scope)->names;
	char text[3 * LIMIT_NAME];
	enum diag_id why;
	const struct meaning *m = scope_find(scope, pou, array, &why);
	int size;

	if (!m || (m->kind != MEANING_ARRAY && m->kind != MEANING_ADDRESS))
		return 0;
	size = snprintf(text, sizeof(text), "%s[%ld]%.*s", names_text(names, array),
			(long)m->array.low, (int)len, tail);
	return size < 0 || (size_t)size >= sizeof(text) ? 0 :
	       names_intern(names, text, (size_t)size);
}
