/* SPDX-License-Identifier: MIT
 *
 * named - enumerations, subranges, and other names of types.
 *
 * A type may be declared below its use, so names are resolved when a project has been read.
 */
#include "engine/model/named.h"

#include "engine/base/ascii.h"
#include "engine/base/name.h"
#include "engine/model/shape.h"

#include <stdio.h>
#include <string.h>

enum state { STATE_OPEN, STATE_WORKING, STATE_DONE };

int named_find(const struct project *project, uint32_t fold)
{
	for (int i = 0; fold && i < project->named_count; i++)
		if (project->named[i].fold == fold)
			return i;
	return -1;
}

const struct enum_value *named_value(const struct project *project, int enumeration, uint32_t fold)
{
	const struct enumeration *list = &project->enumeration[enumeration];

	for (int i = list->first; i < list->first + list->count; i++)
		if (project->enum_value[i].fold == fold)
			return &project->enum_value[i];
	return NULL;
}

bool named_may_hold(const struct project *project, const struct var *var, int64_t number)
{
	if (var->enumeration)
		return named_word(project, var, number) != NULL;
	return !var->range || (number >= var->range->low && number <= var->range->high);
}

const char *named_word(const struct project *project, const struct var *var, int64_t number)
{
	const struct enumeration *list;

	if (!var->enumeration)
		return NULL;
	list = &project->enumeration[var->enumeration - 1];
	for (int i = list->first; i < list->first + list->count; i++)
		if (project->enum_value[i].number == number)
			return project_text(project, project->enum_value[i].name);
	return NULL;
}

int named_print(const struct project *project, const struct var *var, char *out, size_t size)
{
	const struct enumeration *list;
	int used = 0;

	if (!var->enumeration)
		return snprintf(out, size, "%lld..%lld", (long long)(var->range ? var->range->low : 0),
				(long long)(var->range ? var->range->high : 0));
	list = &project->enumeration[var->enumeration - 1];
	for (int i = 0; i < list->count && i < 4 && used >= 0 && (size_t)used < size; i++)
		used += snprintf(out + used, size - (size_t)used, "%s%.24s", i ? ", " : "",
				 i == 3 && list->count > 4 ? "..." : project_text(project,
				 project->enum_value[list->first + i].name));
	return used;
}

/* Is @len bytes of @text a spelling of the string @id? Interns nothing. */
static bool is_spelling(const struct project *project, uint32_t id, const char *text, size_t len)
{
	return name_is(project_text(project, id), text, len);
}

/* The named type that @len bytes of @name are; -1: none. */
static int type_called(const struct project *project, const char *name, size_t len)
{
	for (int i = 0; i < project->named_count; i++)
		if (is_spelling(project, project->named[i].name, name, len))
			return i;
	return -1;
}

/* `Color#Red`; @head: bytes before the sign. */
static bool typed_number(const struct project *project, const char *text, size_t len, size_t head,
			 int64_t *out, enum diag_id *why)
{
	const int type = type_called(project, text, head);
	const struct var *like = type < 0 ? NULL : project->named[type].like.var;
	const struct enumeration *list;

	if (!like || !like->enumeration)
		return false;
	list = &project->enumeration[like->enumeration - 1];
	for (int i = list->first; i < list->first + list->count; i++)
		if (is_spelling(project, project->enum_value[i].name, text + head + 1, len - head - 1)) {
			*out = project->enum_value[i].number;
			return true;
		}
	*why = DIAG_NO_SUCH_VALUE;
	return false;
}

bool named_number(const struct project *project, const char *text, size_t len, int64_t *out,
		  enum diag_id *why)
{
	const struct enum_value *found = NULL;
	size_t head = 0;

	while (head < len && text[head] != '#' && text[head] != '.')
		head++;
	if (head < len)
		return typed_number(project, text, len, head, out, why);
	for (int i = 0; i < project->enum_value_count; i++) {
		const struct enum_value *value = &project->enum_value[i];

		if (!is_spelling(project, value->name, text, len))
			continue;
		if (found && found->number != value->number) {
			*why = DIAG_AMBIGUOUS_VALUE;
			return false;
		}
		found = value;
	}
	if (found)
		*out = found->number;
	return found != NULL;
}

/* The types that have the value @name: "Color#Red or Signal#Red". */
static void print_types(const struct project *project, const char *name, char *out, size_t size)
{
	const size_t len = strlen(name);
	size_t used = 0;

	for (int i = 0; i < project->enum_value_count && used < size; i++) {
		const struct enum_value *value = &project->enum_value[i];
		const uint32_t type = project->enumeration[value->enumeration].name;

		if (type && is_spelling(project, value->name, name, len))
			used += (size_t)snprintf(out + used, size - used, "%s%.40s#%.40s",
						 used ? ", " : "", project_text(project, type),
						 project_text(project, value->name));
	}
}

void named_tell(const struct project *project, enum diag_id why, const char *name, char *out,
		size_t size)
{
	const char *index = strrchr(name, '[');
	char inner[LIMIT_NAME + 1];
	size_t head;
	int type, used;

	if (why == DIAG_AMBIGUOUS_VALUE && index) { /* List[Red]: the index */
		index += 1 + strspn(index + 1, " ");
		snprintf(inner, sizeof(inner), "%.*s", (int)strcspn(index, " ,]"), index);
		name = inner;
	}
	head = strcspn(name, "#.");
	used = snprintf(out, size, "%.60s", name);

	if (used < 0 || (size_t)used + 2 >= size)
		return;
	if (why == DIAG_AMBIGUOUS_VALUE) {
		memcpy(out + used, DIAG_AND, 2);
		print_types(project, name, out + used + 1, size - (size_t)used - 1);
	} else if (why == DIAG_NO_SUCH_VALUE) {
		type = type_called(project, name, head);
		memcpy(out + used, DIAG_AND, 2);
		if (type >= 0)
			named_print(project, project->named[type].like.var, out + used + 1,
				    size - (size_t)used - 1);
	}
}

/* ---- types ---- */

static bool report(const struct project *project, const struct named_type *type, enum diag_id id,
		   struct diag_list *diags)
{
	return diag_add(diags, (struct diag){ .id = id, .file = type->file, .line = type->line }, "%s",
			project_text(project, type->name));
}

/* What a variable or element of this type holds that is given no value. False: 0. */
static bool first_value(const struct project *project, const struct var *var, union iec_value *out)
{
	const struct var *like = var->named ? project->named[var->named - 1].like.var : NULL;

	*out = (union iec_value){ .i = 0 };
	if (like && like->has_init && !like->array.count)
		*out = like->init;
	else if (var->enumeration && project->enumeration[var->enumeration - 1].count)
		out->i = project->enum_value[project->enumeration[var->enumeration - 1].first].number;
	else if (var->range)
		out->i = var->range->low;
	return out->i != 0;
}

/* The elements behind those of the list get @value. */
static bool fill(struct project *project, struct var *var, union iec_value value)
{
	const int count = var->init_count;
	struct var_init *list = arena_alloc(&project->arena, ((size_t)count + 1) * sizeof(*list));
	uint32_t given = 0;

	if (!list)
		return false;
	for (int i = 0; i < count; i++) {
		list[i] = var->init_list[i];
		given += list[i].count;
	}
	if (given >= var->array.count)
		return true;
	list[count] = (struct var_init){ .count = var->array.count - given, .value = value };
	var->init_list = list;
	var->init_count = count + 1;
	return true;
}

/* An array of structures whose type has a value: [3(Speed := 5)]. */
static bool repeat_text(struct project *project, struct var *var)
{
	const uint32_t id = var_value_text(project->named[var->named - 1].like.var);
	const size_t len = names_len(&project->names, id);
	char *text = arena_alloc(&project->arena, len + 16);

	if (!text)
		return false;
	const int used = snprintf(text, len + 16, "[%u%s]", var->array.count, project_text(project, id));

	var->has_init = var->inherits = true;
	var->init_text = names_intern(&project->names, text, (size_t)used);
	return var->init_text != 0;
}

bool named_default(struct project *project, struct var *var)
{
	const struct var *like = var->named ? project->named[var->named - 1].like.var : NULL;
	union iec_value value;

	if (var->type == IEC_NONE && like && like->has_init && !like->array.count &&
	    var->array.count && !var->has_init)
		return repeat_text(project, var);
	if (var->type == IEC_NONE || var->type == IEC_STRING || !first_value(project, var, &value) ||
	    (var->has_init && !var->array.count))
		return true;
	if (!var->has_init)
		var->inherits = true;
	var->has_init = true;
	if (var->array.count)
		return fill(project, var, value);
	var->init = value;
	return true;
}

/* An array of arrays: each of them gets the list of @like. */
static bool repeat_list(struct project *project, struct var *var, const struct var *like)
{
	const uint32_t times = var->array.count / like->array.count;
	const size_t one = (size_t)like->init_count + 1;
	struct var_init *list = arena_alloc(&project->arena, times * one * sizeof(*list));
	int count = 0;

	if (!list)
		return false;
	for (uint32_t i = 0; i < times; i++) {
		uint32_t left = like->array.count;

		for (int k = 0; k < like->init_count; k++) {
			list[count++] = like->init_list[k];
			left -= like->init_list[k].count;
		}
		if (left)
			list[count++] = (struct var_init){ .count = left };
	}
	var->has_init = var->inherits = true;
	var->init_list = list;
	var->init_count = count;
	return true;
}

/* The initial value of an array of a type that has one is that of each element. */
static bool take_value(struct project *project, struct var *var, const struct var *like)
{
	if (!var->has_init && like->has_init && like->array.count && like->type != IEC_NONE &&
	    var->array.count > like->array.count)
		return repeat_list(project, var, like);
	if (var->has_init || !like->has_init || var->array.count != like->array.count)
		return named_default(project, var);
	var->has_init = var->inherits = true;
	var->init = like->init;
	if (like->array.count && like->type != IEC_NONE) {
		var->init_list = like->init_list;
		var->init_count = like->init_count;
	}
	var->init_text = var_value_text(like);
	return true;
}

/* The dimensions of the declaration, and behind them those of its type. */
static bool take_dimensions(struct project *project, struct var *var, const struct var *like)
{
	const int own = var->own_dims, all = own + like->dims;
	struct var_array *dim = arena_alloc(&project->arena, (size_t)all * sizeof(*dim));

	if (!dim || all > LIMIT_INDICES)
		return false;
	for (int i = 0; i < all; i++)
		dim[i] = i < own ? var->dim[i] : like->dim[i - own];
	var->dim = dim;
	var->dims = (uint8_t)all;
	var->array = vars_flat(dim, all);
	return true;
}

bool named_take(struct project *project, struct var *var)
{
	const struct named_type *type = &project->named[var->named - 1];
	const struct var *like = type->like.var;

	if (var->inherits) {
		var->has_init = var->inherits = false;
		var->init_text = 0;
		var->init_count = 0;
		var->init_list = NULL;
	}
	var->type = like->type;
	var->fb = like->fb;
	var->capacity = like->capacity;
	var->enumeration = like->enumeration;
	var->range = like->range;
	var->target = like->target;
	if (like->array.count && !take_dimensions(project, var, like))
		return false;
	return take_value(project, var, like);
}

static bool resolve_type(struct project *project, struct named_type *type, struct diag_list *diags);

/* @var has a named type. */
static bool resolve_var(struct project *project, struct var *var, struct diag_list *diags)
{
	struct named_type *type = &project->named[var->named - 1];
	const struct var *like = type->like.var;

	if (!like || !resolve_type(project, type, diags))
		return false;
	if (like->written && !var->written) {
		var->written = arena_alloc(&project->arena, sizeof(*var->written));
		if (!var->written)
			return false;
		var->written->file = type->file;
	}
	if (var->written)
		var->written->type = like->written;
	return named_take(project, var);
}

/* Depth: a chain of types, each counted. */
static bool resolve_type(struct project *project, struct named_type *type, struct diag_list *diags)
{
	struct named_type *stack[LIMIT_NESTING];
	struct named_type *at = type;
	bool good = true;
	int depth = 0;

	while (at->state == STATE_OPEN && depth < LIMIT_NESTING) {
		at->state = STATE_WORKING;
		stack[depth++] = at;
		if (!at->like.var || !at->like.var->named)
			break;
		at = &project->named[at->like.var->named - 1];
	}
	if (at->state == STATE_OPEN) /* a chain as deep as this is no type of a person */
		good = report(project, at, DIAG_TOO_DEEP, diags);
	else if (at->state == STATE_WORKING && depth && at != stack[depth - 1])
		good = report(project, at, DIAG_CONTAINS_ITSELF, diags);
	else if (at->state == STATE_WORKING && depth && at->like.var && at->like.var->named)
		good = report(project, at, DIAG_CONTAINS_ITSELF, diags);
	while (depth-- > 0) {
		struct var *var = stack[depth]->like.var;

		stack[depth]->state = STATE_DONE;
		if (!var)
			continue;
		if (var->named && good)
			good = resolve_var(project, var, diags);
		else if (good)
			good = named_default(project, var);
	}
	return good && type->like.var;
}

static bool resolve_table(struct project *project, struct var_table *table, struct diag_list *diags)
{
	bool good = true;

	for (int i = 0; i < table->count; i++) {
		if (table->var[i].named)
			good = resolve_var(project, &table->var[i], diags) && good;
		else
			good = named_default(project, &table->var[i]) && good;
	}
	return good;
}

/* What the pointers of a table lead to, all types being known. A pointer to its own type ends at LIMIT_NESTING. */
static bool resolve_targets(struct project *project, struct var_table *table, struct diag_list *diags)
{
	bool good = true;

	for (int i = 0; i < table->count; i++) {
		const struct var_target *target = table->var[i].target;

		for (int depth = 0; target && depth < LIMIT_NESTING; depth++) {
			if (target->like->named)
				good = resolve_var(project, target->like, diags) && good;
			target = target->like->target;
		}
	}
	return good;
}

static bool resolve_both(struct project *project, struct var_table *table, struct diag_list *diags)
{
	return resolve_table(project, table, diags) && resolve_targets(project, table, diags);
}

bool project_resolve(struct project *project, struct diag_list *diags)
{
	bool good = true;

	if (!project->named_count && !project->enumeration_count && !project->ranges)
		return true;
	for (int i = 0; i < project->named_count; i++)
		project->named[i].state = STATE_OPEN;
	for (int i = 0; i < project->named_count; i++)
		good = resolve_type(project, &project->named[i], diags) && good;
	if (!good)
		return false;
	for (int i = 0; i < project->named_count; i++)
		good = resolve_targets(project, &project->named[i].like, diags) && good;
	good = resolve_both(project, &project->globals, diags) && good;
	for (int i = 0; i < project->pou_count; i++)
		good = resolve_both(project, &project->pou[i].vars, diags) && good;
	for (int i = 0; i < project->structure_count; i++)
		good = resolve_both(project, &project->structure[i].vars, diags) && good;
	good = resolve_table(project, &project->located, diags) && good;
	for (int i = 0; i < project->access_count; i++)
		if (project->access[i].var.named)
			good = resolve_var(project, &project->access[i].var, diags) && good;
	return good;
}

/* ---- paths ---- */

static const struct var *find_in(struct project *project, const struct var_table *table,
				 const char *name, size_t len)
{
	const uint32_t fold = names_fold(&project->names, names_intern(&project->names, name, len));
	const int index = table ? vars_find(table, fold) : -1;

	return index < 0 ? NULL : &table->var[index];
}

/* The next part of a path, without its indices; @text moves behind it. */
static size_t part_of(const char **text, const char *end)
{
	const char *from = *text;
	size_t len;

	while (*text < end && **text != '.' && **text != '[')
		++*text;
	len = (size_t)(*text - from);
	while (*text < end && **text != '.')
		++*text;
	*text += *text < end;
	return len;
}

const struct var *named_of_path(struct project *project, const char *path, size_t len)
{
	const char *at = path, *end = path + len, *from = at;
	size_t head = part_of(&at, end);
	const int pou = project_find_pou(project, path, head);
	const struct var *var = NULL;

	if (pou >= 0 && at < end) {
		from = at;
		head = part_of(&at, end);
		var = find_in(project, &project->pou[pou].vars, from, head);
	}
	if (!var)
		var = find_in(project, &project->globals, from, head);
	for (int i = 0; !var && i < project->pou_count; i++)
		var = find_in(project, &project->pou[i].vars, from, head);
	while (var && at < end) {
		from = at;
		head = part_of(&at, end);
		var = var->type == IEC_NONE ?
		      find_in(project, shape_vars(project, var->fb), from, head) : NULL;
	}
	return var;
}
