/* SPDX-License-Identifier: MIT
 *
 * frame - the walker's variables: globals, and those of a program, a function, each
 * instance of a block, each structure; found by name.
 *
 * Each instance has its own copy of the body, on its own variables: the engine copies
 * variables instead.
 */
#include "tests/walker/grid.h"

#include "engine/model/shape.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

static struct value valued(enum iec_type type, union iec_value from)
{
	struct value value = { .type = type };

	if (type == IEC_REAL)
		value.r = (float)from.r;
	else if (type == IEC_LREAL)
		value.d = from.r;
	else
		value.i = from.i;
	return value;
}

static uint32_t count_of(const struct var *var)
{
	return var->array.count ? var->array.count : 1;
}

/* Element @number with its declared initial value. */
static struct value initial(const struct var *var, uint32_t number)
{
	if (var->has_init && !var->array.count)
		return valued(var->type, var->init);
	for (int i = 0; i < var->init_count; i++) {
		if (number < var->init_list[i].count)
			return valued(var->type, var->init_list[i].value);
		number -= var->init_list[i].count;
	}
	return (struct value){ .type = var->type };
}

static struct block *new_block(struct walker *walker, enum word fb)
{
	struct block *block = arena_alloc(&walker->arena, sizeof(*block));
	const struct word_row *row = word_row(fb);

	if (!block)
		return NULL;
	block->fb = fb;
	for (int i = 0; i < row->pin_count && i < PINS_MAX; i++) {
		block->pin[i].type = row->pin[i].type;
		if (row->pin[i].type == IEC_REAL)
			block->pin[i].r = (float)pin_init(&row->pin[i]).r;
		else
			block->pin[i].i = pin_init(&row->pin[i]).i;
	}
	return block;
}

static struct value initial_text(struct walker *walker, const struct var *var)
{
	const char *text = project_text(walker->project, var_value_text(var));
	struct value value = { .type = IEC_STRING, .room = var->capacity };
	struct literal literal;

	if (value.room > (int)sizeof(value.text))
		value.room = sizeof(value.text);
	if (var->has_init &&
	    literal_parse(text, strlen(text), &literal) == LITERAL_OK)
		placed_take_text(&value, &literal);
	return value;
}

static void fill(struct walker *walker, struct variable *variable)
{
	const struct var *var = variable->var;

	for (uint32_t i = 0; i < count_of(var); i++) {
		struct placed all, there;

		if (var->type == IEC_STRING)
			variable->value[i] = initial_text(walker, var);
		else
			variable->value[i] = initial(var, i);
		if (var->at.area == AREA_NONE || !var->has_init)
			continue;
		all = placed_at(walker, var->at, var->type);
		all.count = count_of(var);
		if (placed_element(&all, i, &there))
			placed_write(&there, variable->value[i]);
	}
}

void frame_reset(struct walker *walker, struct frame *frame, bool temporary)
{
	for (int i = 0; i < frame->count; i++) {
		struct variable *at = &frame->variable[i];

		for (uint32_t k = 0; k < count_of(at->var) && at->inner &&
		     (!temporary || at->flags & VAR_TEMP); k++)
			frame_reset(walker, &at->inner[k], false);
		if (at->value && (!temporary || at->flags & VAR_TEMP))
			fill(walker, at);
	}
}

/* The inner frames of a variable: for the instance of a block, a structure, or many. */
static bool make_inner(struct walker *walker, struct variable *variable)
{
	const struct var *var = variable->var;
	uint32_t count = count_of(var);

	variable->inner = arena_alloc(&walker->arena, count * sizeof(*variable->inner));
	for (uint32_t i = 0; variable->inner && i < count; i++)
		if (!frame_make(walker, &variable->inner[i],
				shape_pou(walker->project, var->fb),
				shape_vars(walker->project, var->fb)))
			return false;
	return variable->inner;
}

/* Depth: nested declarations, at most LIMIT_NESTING. */
bool frame_make(struct walker *walker, struct frame *frame, const struct pou *pou,
		const struct var_table *table)
{
	frame->pou = pou;
	frame->variable = arena_alloc(&walker->arena, (size_t)table->count *
				      sizeof(*frame->variable) + 1);
	if (!frame->variable)
		return false;
	for (int i = 0; i < table->count; i++) {
		struct variable *at = &frame->variable[frame->count++];

		at->var = &table->var[i];
		at->flags = vars_flags(table, i);
		if (at->var->type != IEC_NONE) {
			at->value = arena_alloc(&walker->arena, count_of(at->var) *
						sizeof(*at->value));
			if (!at->value)
				return false;
			fill(walker, at);
		} else if (word_is_own(at->var->fb)) {
			if (!make_inner(walker, at))
				return false;
		} else {
			at->block = new_block(walker, at->var->fb);
			if (!at->block)
				return false;
		}
	}
	if (pou && pou->kind == POU_BLOCK) {
		frame->next = walker->instances;
		walker->instances = frame;
	}
	return true;
}

/* ---- by name ---- */

int frame_find(const struct walker *walker, const struct frame *frame, const char *text,
	       size_t len)
{
	for (int i = 0; i < frame->count; i++) {
		const char *name = project_text(walker->project,
						frame->variable[i].var->name);

		/* The first letter differs for most names. */
		if ((name[0] | 32) == (text[0] | 32) &&
		    strncasecmp(name, text, len) == 0 && name[len] == '\0')
			return i;
	}
	return -1;
}

static struct placed of_value(struct walker *walker, struct variable *variable)
{
	const struct var *var = variable->var;
	struct placed placed = { .kind = PLACED_VALUE, .type = var->type,
				 .value = variable->value };

	if (var->at.area != AREA_NONE)
		placed = placed_at(walker, var->at, var->type);
	placed.count = var->array.count;
	placed.low = var->array.low;
	return placed;
}

static struct placed of_pin(struct block *block, const char *text, size_t len)
{
	struct placed placed = { .kind = PLACED_NOWHERE };
	char name[32] = "";
	int pin;

	if (len >= sizeof(name))
		return placed;
	memcpy(name, text, len);
	pin = block_pin(block, name);
	if (pin < 0)
		return placed;
	placed.kind = PLACED_VALUE;
	placed.value = &block->pin[pin];
	placed.type = placed.value->type;
	return placed;
}

/* A path that is being resolved: the rest of it, and where its indices are stored. */
struct path {
	const struct frame *frame;
	const char *at, *end;
};

static struct placed follow(struct walker *walker, struct path path,
			    struct variable *variable);

/* `.Member…` of a structure or instance. */
static struct placed of_member(struct walker *walker, struct path path,
			       struct frame *inner)
{
	const char *name = path.at + 1;
	int found;

	for (path.at = name; path.at < path.end && *path.at != '.' && *path.at != '[';)
		path.at++;
	found = frame_find(walker, inner, name, (size_t)(path.at - name));
	return found < 0 ? (struct placed){ .kind = PLACED_NOWHERE } :
			   follow(walker, path, &inner->variable[found]);
}

/* `[i].Member…`: with a computed index, one of many places. */
static struct placed of_elements(struct walker *walker, struct path path,
				 struct variable *variable)
{
	struct placed none = { .kind = PLACED_NOWHERE }, all = none;
	const char *close = memchr(path.at, ']', (size_t)(path.end - path.at));
	uint32_t count = count_of(variable->var);

	if (!close)
		return none;
	all.choice = arena_alloc(&walker->arena, count * sizeof(*all.choice));
	all.count = count;
	all.low = variable->var->array.low;
	for (uint32_t i = 0; all.choice && i < count; i++) {
		struct path rest = { path.frame, close + 1, path.end };

		all.choice[i] = of_member(walker, rest, &variable->inner[i]);
		all.kind = all.choice[i].kind;
		all.type = all.choice[i].type;
	}
	return placed_index(walker, path.frame, all, path.at + 1, close);
}

static struct placed follow(struct walker *walker, struct path path,
			    struct variable *variable)
{
	struct placed none = { .kind = PLACED_NOWHERE };
	bool more = path.at < path.end;

	if (variable->inner && more)
		return *path.at == '[' ? of_elements(walker, path, variable) :
					 of_member(walker, path, variable->inner);
	if (variable->block && more)
		return of_pin(variable->block, path.at + 1,
			      (size_t)(path.end - path.at - 1));
	if (!variable->value)
		return none;
	return more ? placed_index(walker, path.frame, of_value(walker, variable),
				   path.at + 1, path.end - 1) :
		      of_value(walker, variable);
}

struct variable *frame_variable(struct walker *walker, const struct frame *frame,
				const char *text, size_t len)
{
	int found = frame ? frame_find(walker, frame, text, len) : -1;

	if (found >= 0)
		return &frame->variable[found];
	found = frame_find(walker, &walker->globals, text, len);
	return found < 0 ? NULL : &walker->globals.variable[found];
}

struct placed frame_place(struct walker *walker, const struct frame *frame,
			  const char *text, size_t len)
{
	struct path path = { frame, text, text + len };
	struct variable *variable;

	/* Fill.X of a step is one variable. */
	if (frame && frame_find(walker, frame, text, len) >= 0)
		path.at = path.end;
	while (path.at < path.end && *path.at != '.' && *path.at != '[')
		path.at++;
	variable = frame_variable(walker, frame, text, (size_t)(path.at - text));
	return variable ? follow(walker, path, variable) :
			  (struct placed){ .kind = PLACED_NOWHERE };
}

/* ---- for comparison ---- */

static struct shown *show(struct walker *walker, const char *name, const char *more)
{
	struct shown *out;

	if (walker->shown_count == SHOWN_MAX)
		return NULL;
	out = arena_push(&walker->arena, &walker->shown, &walker->shown_count,
			 sizeof(*out));
	if (!out)
		return NULL;
	snprintf(out->name, sizeof(out->name), "%.100s%.24s", name, more);
	return out;
}

static void show_value(struct walker *walker, struct variable *variable, const char *name)
{
	struct placed all = of_value(walker, variable);
	struct shown *out;
	char index[24];

	for (uint32_t i = 0; i < all.count; i++) {
		snprintf(index, sizeof(index), "[%d]", (int)(all.low + (int64_t)i));
		out = show(walker, name, index);
		if (out)
			placed_element(&all, all.low + (int64_t)i, &out->placed);
	}
	out = all.count ? NULL : show(walker, name, "");
	if (out)
		out->placed = all;
}

static void show_pins(struct walker *walker, struct block *block, const char *name)
{
	const struct word_row *row = word_row(block->fb);
	char pin[40];

	for (int i = 0; i < row->pin_count; i++) {
		struct shown *out;

		if (row->pin[i].dir == PIN_VAR)
			continue;
		snprintf(pin, sizeof(pin), ".%s", row->pin[i].name);
		out = show(walker, name, pin);
		if (!out)
			return;
		out->placed = (struct placed){ .kind = PLACED_VALUE,
			.type = row->pin[i].type, .value = &block->pin[i] };
		if (row->pin[i].dir == PIN_IN)
			out->block = block;
	}
}

/* Parameters that a call copies are not compared between scans. */
static void show_frame(struct walker *walker, const struct frame *frame,
		       const char *before)
{
	char name[128];

	for (int i = 0; i < frame->count; i++) {
		struct variable *at = &frame->variable[i];
		const char *own = project_text(walker->project, at->var->name);

		if (at->flags & (VAR_TEMP | VAR_IN_OUT) ||
		    (at->flags & VAR_SFC && !strcmp(own, SFC_CONDITION)))
			continue;
		snprintf(name, sizeof(name), "%.90s%.30s", before, own);
		for (uint32_t k = 0; at->inner && k < count_of(at->var); k++) {
			if (at->var->array.count)
				snprintf(name, sizeof(name), "%.70s%.20s[%d].", before, own,
					 (int)(at->var->array.low + (int64_t)k));
			else
				snprintf(name, sizeof(name), "%.90s%.30s.", before, own);
			snprintf(at->inner[k].name, sizeof(at->inner[k].name), "%.*s",
				 (int)strlen(name) - 1, name);
			show_frame(walker, &at->inner[k], name);
		}
		if (at->block)
			show_pins(walker, at->block, name);
		else if (at->value)
			show_value(walker, at, name);
	}
}

static bool show_all(struct walker *walker)
{
	struct project *project = walker->project;
	char name[128];

	show_frame(walker, &walker->globals, "");
	for (int i = 0; i < project->pou_count; i++) {
		snprintf(name, sizeof(name), "%.90s.",
			 project_text(project, project->pou[i].name));
		if (!pou_has_frame(&project->pou[i]))
			show_frame(walker, &walker->frame[i], name);
	}
	return true;
}

bool walker_declare(struct walker *walker)
{
	struct project *project = walker->project;

	if (!project_areas(project, &walker->areas))
		return false;
	for (int i = AREA_NONE + 1; i < AREA_COUNT; i++) {
		walker->area[i] = arena_alloc(&walker->arena,
			walker->areas.bytes[i] + 8);
		if (!walker->area[i])
			return false;
	}
	walker->frame = arena_alloc(&walker->arena, (size_t)project->pou_count *
				    sizeof(*walker->frame) + 1);
	if (!walker->frame || !frame_make(walker, &walker->globals, NULL,
					  &project->globals))
		return false;
	for (int i = 0; i < project->pou_count; i++) {
		const struct pou *pou = &project->pou[i];

		/* A block has variables only in its instances. */
		if (pou->kind != POU_BLOCK &&
		    !frame_make(walker, &walker->frame[i], pou, &pou->vars))
			return false;
	}
	return show_all(walker);
}
