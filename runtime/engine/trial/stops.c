/* SPDX-License-Identifier: MIT
 *
 * stops - breakpoints and single steps: see stops.h.
 */
#include "engine/trial/stops.h"

#include "engine/base/name.h"
#include "engine/trial/formula.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BEGINS = 1, BREAKS = 2 };

struct stop {
	uint32_t word;
	struct formula *condition;
	const char *instance;
	bool once;
};

struct stops {
	struct vm_stand stand;
	const struct program *program;
	uint8_t *begins;       /* by word of CODE_WATCH: BEGINS, BREAKS       */
	struct stop *stop;
	size_t count, room;
	/* The step that is done, and where it began. */
	enum stops_step step;
	uint32_t starts, depth, back;
	bool caller;           /* the caller has statements, too              */
	struct stops_frame frame[LIMIT_CALLS + 1]; /* as find_stack() saw it  */
	int frames;
};

/* ---- places ---- */

static bool is_statement(const struct program *program, const struct code_place *place)
{
	return place->col == CODE_LINE && place->row && place->text >= program->text_words;
}

static uint32_t word_of(const struct program *program, const struct code_place *place)
{
	return place->text - program->text_words;
}

/* The POU whose words these are. */
static uint32_t pou_of(const struct program *program, uint32_t word)
{
	uint32_t pou = 0;

	while (pou + 1 < program->entry_count &&
	       word - program->entry[pou].watch >= program->entry[pou].watch_words)
		pou++;
	return pou;
}

/* The last statement that begins at @word or before, in its POU; NULL: none. */
static const struct code_place *statement_at(const struct program *program, uint32_t word)
{
	const struct code_place *found = NULL;
	const uint32_t pou = pou_of(program, word);

	for (uint32_t i = 0; i < program->place_count; i++) {
		const struct code_place *place = &program->place[i];

		if (place->text > program->text_words + word)
			break;
		if (place->pou == pou && is_statement(program, place))
			found = place;
	}
	return found;
}

/* The first one in that line, or the first line behind it. */
static const struct code_place *find_line(const struct program *program, uint32_t pou, uint32_t line)
{
	const struct code_place *found = NULL;

	for (uint32_t i = 0; i < program->place_count; i++) {
		const struct code_place *place = &program->place[i];

		if (place->pou != pou || place->rung < line || !is_statement(program, place))
			continue;
		if (!found || place->rung < found->rung ||
		    (place->rung == found->rung && place->row < found->row))
			found = place;
	}
	return found;
}

uint32_t stops_line(const struct program *program, uint32_t pou, uint32_t line)
{
	const struct code_place *place = find_line(program, pou, line);

	return place ? place->rung : 0;
}

/* ---- breakpoints ---- */

void stops_clear(struct stops *stops)
{
	for (size_t i = 0; i < stops->count; i++)
		stops->begins[stops->stop[i].word] = BEGINS;
	stops->count = 0;
}

bool stops_add(struct stops *stops, uint32_t pou, uint32_t line, struct formula *condition,
	       const char *instance, bool once)
{
	const struct code_place *place = find_line(stops->program, pou, line);
	struct stop *grown = stops->stop;

	if (!place || place->rung != line)
		return false;
	if (stops->count == stops->room) {
		grown = realloc(stops->stop, (2 * stops->room + 8) * sizeof(*grown));
		if (!grown)
			return false;
		stops->stop = grown;
		stops->room = 2 * stops->room + 8;
	}
	grown[stops->count++] = (struct stop){ word_of(stops->program, place), condition, instance,
						once };
	stops->begins[word_of(stops->program, place)] = BEGINS | BREAKS;
	return true;
}

static void drop_once(struct stops *stops)
{
	size_t kept = 0;

	for (size_t i = 0; i < stops->count; i++) {
		stops->begins[stops->stop[i].word] = BEGINS;
		if (!stops->stop[i].once)
			stops->stop[kept++] = stops->stop[i];
	}
	stops->count = kept;
	for (size_t i = 0; i < kept; i++)
		stops->begins[stops->stop[i].word] = BEGINS | BREAKS;
}

/* ---- who called ---- */

/* Where the element of ABLOCK is. The indices of a call keep their values while the body runs. */
static uint32_t element_of(const uint32_t *code, uint32_t base, const uint8_t *memory)
{
	const uint32_t *dim = code + 6;

	for (uint32_t i = 0; i <= code[0] >> 9; i++, dim += CODE_DIMENSION) {
		const union iec_value index = iec_load(memory + CODE_OFFSET(dim[0]),
						       (enum iec_type)CODE_TYPE(dim[0]));

		base += (uint32_t)(index.i - (int32_t)dim[1]) * dim[3];
	}
	return base;
}

/* What the call copies to the frame of a block, and where; size 0: nothing, as of a function. */
static void find_copied(const struct program *program, uint32_t caller, uint32_t call,
			const uint8_t *memory, struct stops_frame *frame)
{
	const struct code_program *at = &program->entry[caller];
	const uint32_t *pc = program->watch + at->watch, *end = program->watch + call, *last = NULL;
	const uint32_t *back = end + 2; /* END at least stands behind a call */

	if ((*back & 0xff) == VM_ABLOCK && *back >> 8 & 1) {
		frame->frame = back[4];
		frame->kept = element_of(back, back[3], memory);
		frame->size = back[5];
		return;
	}
	for (; pc < end; pc += code_words(pc))
		last = pc;
	if (!last || (*last & 0xff) != VM_BLOCK)
		return;
	frame->frame = last[1];
	frame->kept = last[2];
	frame->size = last[3];
}

static bool is_in(uint32_t where, uint32_t from, uint32_t size)
{
	return where - from < size;
}

/* Is @name, a part of the instance @watched, perhaps in front of it the program? */
static bool is_part(const char *instance, const struct declared_name *part)
{
	const size_t len = strlen(instance), pou = strlen(part->pou);

	if (strncmp(part->name, instance, len) == 0 && part->name[len] == '.')
		return true;
	return pou && len > pou && strncmp(instance, part->pou, pou) == 0 && instance[pou] == '.' &&
	       strncmp(part->name, instance + pou + 1, len - pou - 1) == 0 &&
	       part->name[len - pou - 1] == '.';
}

static const char *name_of(const struct program *program, uint32_t pou)
{
	return program->string_bytes ? program->string + program->entry[pou].name : "";
}

/* The POU whose action this is: Fill of Fill.Drain; of others itself. */
static uint32_t owner_of(const struct program *program, uint32_t pou)
{
	const char *name = name_of(program, pou), *dot = strrchr(name, '.');

	for (uint32_t i = 0; dot && i < program->entry_count; i++) {
		const char *other = name_of(program, i);

		if (name_same(name, (size_t)(dot - name), other, strlen(other)))
			return i;
	}
	return pou;
}

/* The instance whose parts lie at frame->kept; NULL: none has a name. */
static const struct code_watched *find_watched(const struct program *program,
					       const struct stops_frame *frame)
{
	struct declared_cursor cursor = { 0 };
	struct declared_name part;

	do
		if (!image_next_declared(program, &cursor, &part))
			return NULL;
	while (part.flags & SYMBOL_BIT || !strchr(part.name, '.') ||
	       !is_in(part.at.where, frame->kept, frame->size));
	for (uint32_t i = 0; i < program->watched_count; i++) {
		const struct code_watched *watched = &program->watched[i];

		if (watched->pou == owner_of(program, frame->pou) &&
		    is_part(program->string + watched->name, &part))
			return watched;
	}
	return NULL;
}

/* A block in a block is in the frame of that one while it runs. */
static void find_instance(const struct program *program, struct stops_frame *frame,
			  const struct stops_frame *caller, uint32_t call, const uint8_t *memory)
{
	const struct code_watched *watched;

	find_copied(program, caller->pou, call, memory, frame);
	if (caller->size && is_in(frame->kept, caller->frame, caller->size))
		frame->kept += caller->kept - caller->frame;
	watched = frame->size ? find_watched(program, frame) : NULL;
	if (watched)
		snprintf(frame->instance, sizeof(frame->instance), "%s",
			 program->string + watched->name);
	else
		frame->size = 0;
}

static struct stops_frame frame_at(const struct program *program, uint32_t word)
{
	const struct code_place *place = statement_at(program, word);
	struct stops_frame frame = { .pou = pou_of(program, word) };

	frame.at = resource_place(program, program->text_words + word);
	frame.at.pou = name_of(program, frame.pou);
	if (place) {
		frame.at.line = place->rung;
		frame.at.col = place->row;
		frame.at.rung = frame.at.row = 0;
	}
	return frame;
}

/* A block that calls an action of its own: the action has the same instance. */
static void name_actions(struct stops *stops)
{
	for (int i = stops->frames - 2; i >= 0; i--) {
		struct stops_frame *frame = &stops->frame[i], *caller = frame + 1;
		const uint32_t owner = owner_of(stops->program, frame->pou);

		if (!frame->instance[0] && owner != frame->pou && owner == owner_of(stops->program, caller->pou))
			memcpy(frame->instance, caller->instance, sizeof(frame->instance));
	}
}

/* From the outermost body inwards. @memory: of the twin. */
static void find_stack(struct stops *stops, const uint8_t *memory)
{
	const struct vm_stand *stand = &stops->stand;
	struct stops_frame *out = stops->frame;
	const int last = (int)stand->depth;

	for (int i = 0; i <= last; i++) {
		/* A call goes on behind its two words. */
		const uint32_t word = i == last ? stand->word : stand->back[i] - 2;

		out[last - i] = frame_at(stops->program, word);
		if (i > 0)
			find_instance(stops->program, &out[last - i], &out[last - i + 1],
				      stand->back[i - 1] - 2, memory);
	}
	stops->frames = last + 1;
	name_actions(stops);
}

int stops_stack(struct stops *stops, const struct twin *twin, struct stops_frame *out)
{
	if (!twin->resource.stopped)
		return 0;
	find_stack(stops, twin->resource.image.memory);
	memcpy(out, stops->frame, (size_t)stops->frames * sizeof(*out));
	return stops->frames;
}

/* ---- values of what runs ---- */

/* Where the value is now: in the frame of the innermost body that has it. */
static struct location now_at(const struct stops *stops, struct location at)
{
	for (int i = 0; i < stops->frames; i++) {
		const struct stops_frame *frame = &stops->frame[i];

		if (at.area == AREA_NONE && is_in(at.where, frame->kept, frame->size)) {
			at.where += frame->frame - frame->kept;
			break;
		}
	}
	return at;
}

static struct location kept_at(const struct stops *stops, struct location at)
{
	for (int i = 0; i < stops->frames; i++) {
		const struct stops_frame *frame = &stops->frame[i];

		if (at.area == AREA_NONE && is_in(at.where, frame->frame, frame->size)) {
			at.where += frame->kept - frame->frame;
			break;
		}
	}
	return at;
}

bool stops_act(struct stops *stops, struct twin *twin, const struct act *act)
{
	struct act now = *act;

	if (!twin_act(twin, act))
		return false;
	if (!twin->resource.stopped || act->plant || (act->kind != ACT_SET && act->kind != ACT_FORCE))
		return true;
	find_stack(stops, twin->resource.image.memory);
	now.kind = ACT_SET;
	now.at = now_at(stops, act->at);
	return now.at.where == act->at.where || twin_act(twin, &now);
}

static void show_results(const struct program *program, const struct stops_frame *frame, uint8_t *m)
{
	for (uint32_t i = 0; i < program->watched_count; i++) {
		const struct code_watched *watched = &program->watched[i];

		if (watched->pou == frame->pou &&
		    strcmp(program->string + watched->name, frame->instance) == 0)
			memmove(m + watched->to, m + watched->from, watched->size);
	}
}

/* The innermost last: the frame of what called it has it as it was before. */
void stops_show(struct stops *stops, const struct twin *twin, struct twin *copy)
{
	uint8_t *m = copy->resource.image.memory;

	if (!twin->resource.stopped)
		return;
	find_stack(stops, twin->resource.image.memory);
	for (int i = stops->frames - 1; i >= 0; i--) {
		const struct stops_frame *frame = &stops->frame[i];

		if (!frame->size)
			continue;
		memmove(m + frame->kept, m + frame->frame, frame->size);
		show_results(stops->program, frame, m);
	}
}

/* The condition reads the instance where it is now. */
static bool holds(struct stops *stops, const struct stop *stop, const struct image *image)
{
	struct formula *formula = stop->condition;
	union iec_value value = { .i = 0 };
	bool known;

	if (!formula)
		return true;
	find_stack(stops, image->memory);
	if (stop->instance && strcmp(stop->instance, stops->frame[0].instance) != 0)
		return false;
	for (int i = 0; i < formula->count; i++) {
		formula->term[i].at = now_at(stops, formula->term[i].at);
		formula->term[i].index = now_at(stops, formula->term[i].index);
	}
	known = formula_value(formula, image, &value);
	for (int i = 0; i < formula->count; i++) {
		formula->term[i].at = kept_at(stops, formula->term[i].at);
		formula->term[i].index = kept_at(stops, formula->term[i].index);
	}
	return !known || value.i != 0;
}

static bool breaks(struct stops *stops, const struct image *image)
{
	if (!(stops->begins[stops->stand.word] & BREAKS))
		return false;
	for (size_t i = 0; i < stops->count; i++)
		if (stops->stop[i].word == stops->stand.word && holds(stops, &stops->stop[i], image))
			return true;
	return false;
}

/* ---- steps ---- */

/* Has the body, whose step this is, ended? If its caller has no statements, the next one of another
 * body counts. */
static bool has_left(const struct stops *stops)
{
	const struct vm_stand *stand = &stops->stand;

	if (stand->starts != stops->starts || stand->depth < stops->depth)
		return true;
	return !stops->caller && stand->depth == stops->depth && stops->depth > 0 &&
	       stand->back[stops->depth - 1] != stops->back;
}

static bool is_same_body(const struct stops *stops)
{
	const struct vm_stand *stand = &stops->stand;

	return stand->depth == stops->depth &&
	       (stops->depth == 0 || stand->back[stops->depth - 1] == stops->back);
}

static bool steps(const struct stops *stops)
{
	switch (stops->step) {
	case STOPS_INTO: return true;
	case STOPS_OVER: return has_left(stops) || is_same_body(stops);
	case STOPS_OUT: return has_left(stops);
	case STOPS_GO:
	case STOPS_LEAVE: break;
	}
	return false;
}

static bool asks(struct vm_stand *stand, struct vm *vm)
{
	struct stops *stops = (struct stops *)((char *)stand - offsetof(struct stops, stand));
	const struct resource *resource =
		(const struct resource *)((const char *)vm - offsetof(struct resource, vm));

	if (stops->step == STOPS_LEAVE || (!steps(stops) && !breaks(stops, &resource->image)))
		return false;
	drop_once(stops);
	return true;
}

static bool has_statements(const struct program *program, uint32_t pou)
{
	return find_line(program, pou, 0) != NULL;
}

static void begin_step(struct stops *stops, bool stands, enum stops_step step)
{
	const struct vm_stand *stand = &stops->stand;

	stops->step = step;
	if (!stands) {
		if (step == STOPS_OVER || step == STOPS_OUT)
			stops->step = STOPS_INTO;
		return;
	}
	stops->starts = stand->starts;
	stops->depth = stand->depth;
	stops->back = stand->depth ? stand->back[stand->depth - 1] : 0;
	stops->caller = stand->depth &&
		has_statements(stops->program, pou_of(stops->program, stops->back));
}

bool stops_scan(struct stops *stops, struct twin *twin, enum stops_step step)
{
	struct resource *resource = &twin->resource;
	struct vm *vm = &resource->vm;
	bool goes_on;

	if (!stops->begins)
		return twin_scan(twin);
	if (!resource->stopped) {
		vm->stand = &stops->stand;
		vm->run = vm_run_stepping;
		vm->went_back = NULL;
		stops->stand.stands = false;
	}
	begin_step(stops, resource->stopped, step);
	goes_on = resource->stopped ? twin_go_on(twin) : twin_scan(twin);
	if (!resource->stopped) {
		vm->stand = NULL;
		vm->run = NULL;
		vm->went_back = NULL;
	}
	return goes_on;
}

/* ---- life ---- */

struct stops *stops_new(const struct program *program)
{
	struct stops *stops = calloc(1, sizeof(*stops));

	if (!stops)
		return NULL;
	stops->program = program;
	stops->stand.asks = asks;
	if (!program->watch_words)
		return stops;
	stops->begins = calloc(program->watch_words, 1);
	stops->stand.begins = stops->begins;
	if (!stops->begins) {
		free(stops);
		return NULL;
	}
	for (uint32_t i = 0; i < program->place_count; i++)
		if (is_statement(program, &program->place[i]))
			stops->begins[word_of(program, &program->place[i])] = BEGINS;
	return stops;
}

void stops_free(struct stops *stops)
{
	if (!stops)
		return;
	free(stops->begins);
	free(stops->stop);
	free(stops);
}
