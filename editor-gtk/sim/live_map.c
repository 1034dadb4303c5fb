/* SPDX-License-Identifier: MIT
 *
 * live_map - names and cells of the program that runs: see live_map.h.
 */
#include "editor-gtk/sim/live_map.h"
#include "editor-gtk/kit/name_fold.h"
#include "engine/base/name.h"


#include <string.h>

struct live_map {
	struct image image;          /* only to find names: it has no memory      */
	const struct program *program;
	int unit;                    /* of CODE_PROGRAMS; -1: none              */
	char *pou;
	char *owner;                 /* the POU whose action it is: Fill of Fill.Drain; NULL: it is none */
	const char *within;          /* of the owner: its instance; NULL: none  */
	const struct code_watched *watched; /* the instance that is shown        */
	char *instance;              /* its name: a sheet may be asked for it after the
				      * program has gone; NULL: none */
	GHashTable *names;           /* name_fold(), with POU -> struct location *  */
	LadderSim *sim;              /* NULL: all is known                           */
};

/* ---- names ---- */

static char *key_of(const char *pou, const char *name, size_t len)
{
	char *text = g_strdup_printf("%s%s%.*s", pou, *pou ? "." : "", (int)len, name);
	char *key = name_fold(text);

	g_free(text);
	return key;
}

/* Single values and instances. Others are used rarely: image_find() finds them. */
static void take_names(struct live_map *map)
{
	struct declared_cursor cursor = { 0 };
	struct declared_name name;

	while (image_next_declared(map->program, &cursor, &name)) {
		char *key;

		if (name.array.count || name.flags & SYMBOL_HIDDEN)
			continue;
		key = key_of(name.pou, name.name, strlen(name.name));
		if (g_hash_table_contains(map->names, key))
			g_free(key);
		else
			g_hash_table_insert(map->names, key,
					    g_memdup2(&name.at, sizeof(name.at)));
	}
}

static struct location find_pin(const struct live_map *map, struct location whole,
				const char *pin, size_t len)
{
	const struct word_row *row = word_row(code_instance(map->program, whole.where));
	const int index = word_pin_find(row, pin, len);
	struct location at = { .type = IEC_NONE };

	if (index >= 0) {
		at.type = row->pin[index].type;
		at.where = whole.where + row->pin[index].offset;
	}
	return at;
}

/* @key: taken over. */
static struct location look_up(const struct live_map *map, char *key)
{
	const struct location *at = g_hash_table_lookup(map->names, key);
	struct location found = { .type = IEC_NONE };
	char *dot = strrchr(key, '.');

	if (at)
		found = *at;
	else if (dot && strchr(key, '[') == NULL) {
		*dot = '\0';
		at = g_hash_table_lookup(map->names, key);
		if (at && at->type == IEC_NONE)
			found = find_pin(map, *at, dot + 1, strlen(dot + 1));
		*dot = '.';
	}
	if (found.type == IEC_NONE && strpbrk(key, ".[%"))
		found = image_find(&map->image, key, strlen(key));
	g_free(key);
	return found;
}

void live_map_set_sim(struct live_map *map, LadderSim *sim)
{
	map->sim = sim;
}

static struct location find(const struct live_map *map, const char *name, size_t len)
{
	const char *instance = live_map_instance(map);
	struct location at = { .type = IEC_NONE };

	if (len == 0 || len > LIMIT_NAME * 2)
		return at;
	if (name[0] != '%') {
		at = look_up(map, key_of(instance ? instance : map->pou, name, len));
		if (at.type == IEC_NONE && map->within)
			at = look_up(map, key_of(map->within, name, len));
		if (at.type == IEC_NONE && map->owner)
			at = look_up(map, key_of(map->owner, name, len));
		if (at.type == IEC_NONE && instance)
			at = look_up(map, key_of(map->pou, name, len));
	}
	if (at.type == IEC_NONE)
		at = look_up(map, key_of("", name, len));
	if (at.type == IEC_NONE)
		at = image_find(&map->image, name, len);
	return at;
}

struct location live_map_find(const struct live_map *map, const char *name, size_t len)
{
	const struct location at = find(map, name, len);

	return map->sim && !ladder_sim_knows(map->sim, at) ?
	       (struct location){ .type = IEC_NONE } : at;
}

struct live_named live_map_named(const struct live_map *map, const char *name, size_t len)
{
	char *own = g_strndup(name, len);
	const struct live_named named = live_named_find(map->sim, false, map->owner ? map->owner : map->pou, own);

	g_free(own);
	return named;
}

struct location live_map_find_pin(const struct live_map *map, const char *instance,
				  const char *pin)
{
	char *name = g_strdup_printf("%s.%s", instance, pin);
	const struct location at = live_map_find(map, name, strlen(name));

	g_free(name);
	return at;
}

/* ---- power ---- */

static int compare(const struct code_power *power, int pou, uint32_t rung)
{
	if (power->pou != (uint32_t)pou)
		return power->pou < (uint32_t)pou ? -1 : 1;
	return power->rung < rung ? -1 : power->rung > rung;
}

static bool has_power(const struct live_map *map)
{
	return !map->sim || ladder_sim_has_power(map->sim, map->instance ? map->instance :
						 map->pou);
}

static uint32_t place_of(const struct live_map *map, uint32_t offset)
{
	const struct code_watched *watched = map->watched;

	return watched && offset - watched->from < watched->size ?
	       watched->to + (offset - watched->from) : offset;
}

void live_map_power(const struct live_map *map, struct live_rung *rung)
{
	const struct program *program = map->program;
	const uint32_t number = (uint32_t)rung->number + 1;
	uint32_t low = 0, high = program->power_count;

	if (!has_power(map))
		return;
	while (low < high && map->unit >= 0) {
		const uint32_t middle = low + (high - low) / 2;

		if (compare(&program->power[middle], map->unit, number) < 0)
			low = middle + 1;
		else
			high = middle;
	}
	for (; map->unit >= 0 && low < program->power_count &&
	       compare(&program->power[low], map->unit, number) == 0; low++) {
		const struct code_power *power = &program->power[low];
		struct live_cell *cell;

		if (power->row > rung->rows || power->col > rung->cols)
			continue;
		cell = &rung->cell[(power->row - 1) * rung->cols + power->col - 1];
		cell->in = place_of(map, power->in);
		cell->out = place_of(map, power->out);
	}
}

static bool take_result(const struct live_map *map, const struct code_power *power,
			struct live_result *out)
{
	if (!power || !has_power(map))
		return false;
	out->ran = place_of(map, power->in);
	out->at = (struct location){ .type = (enum iec_type)power->type,
				     .where = place_of(map, power->out) };
	return true;
}

bool live_map_result(const struct live_map *map, uint32_t line, struct live_result *out)
{
	return map->unit >= 0 &&
	       take_result(map, code_result(map->program, (uint32_t)map->unit, line), out);
}

bool live_map_listed(const struct live_map *map, uint32_t number, struct live_result *out)
{
	return map->unit >= 0 &&
	       take_result(map, code_listed(map->program, (uint32_t)map->unit, number), out);
}

bool live_map_is_listed(const struct il_line *line)
{
	return line->kind == IL_OP || line->kind == IL_FN || line->kind == IL_CLOSE ||
	       line->kind == IL_LABEL || line->kind == IL_CALL;
}

uint32_t live_map_before(const struct il *il, int end)
{
	uint32_t count = 0;

	for (int i = 0; i < end && i < il->count; i++)
		count += live_map_is_listed(&il->line[i]);
	return count;
}

bool live_map_made(const struct live_map *map, const struct il *il, int first, int last, uint16_t made,
		   struct live_result *out)
{
	for (int i = 0; made && i < il->count; i++)
		if (il->line[i].made == made && (int)il->line[i].line >= first && (int)il->line[i].line <= last)
			return live_map_listed(map, live_map_before(il, i) + 1, out);
	return false;
}

struct live_result live_map_always(const struct live_map *map)
{
	return (struct live_result){ .ran = CODE_TRUE_AT(&map->program->areas),
				     .at.type = IEC_NONE };
}

/* ---- instances ---- */

GPtrArray *live_map_instances(const struct live_map *map)
{
	GPtrArray *names = g_ptr_array_new();

	for (uint32_t i = 0; i < map->program->watched_count; i++)
		if ((int)map->program->watched[i].pou == map->unit)
			g_ptr_array_add(names, (gpointer)(map->program->string +
							  map->program->watched[i].name));
	return names;
}

const char *live_map_instance(const struct live_map *map)
{
	return map->instance;
}

/* @unit: of the block. */
static const struct code_watched *choose(const struct live_map *map, int unit, const char *instance)
{
	const struct code_watched *first = NULL;

	for (uint32_t i = 0; i < map->program->watched_count; i++) {
		const struct code_watched *watched = &map->program->watched[i];

		if ((int)watched->pou != unit)
			continue;
		if (!first)
			first = watched;
		if (instance && name_equal(map->program->string + watched->name,
						   instance))
			return watched;
	}
	return first;
}

/* ---- life ---- */

static int find_unit(const struct program *program, const char *pou)
{
	for (uint32_t i = 0; i < program->entry_count; i++)
		if (name_equal(program->string + program->entry[i].name, pou))
			return (int)i;
	return -1;
}

static void find_owner(struct live_map *map, const char *instance)
{
	const char *dot = strrchr(map->pou, '.');
	const struct code_watched *watched;
	char *owner = dot ? g_strndup(map->pou, (gsize)(dot - map->pou)) : NULL;
	const int unit = owner ? find_unit(map->program, owner) : -1;

	if (unit < 0) {
		g_free(owner);
		return;
	}
	watched = choose(map, unit, instance);
	map->owner = owner;
	map->within = watched ? map->program->string + watched->name : NULL;
}

struct live_map *live_map_new(const struct resource *resource, const char *pou,
			      const char *instance)
{
	struct live_map *map = g_new0(struct live_map, 1);

	map->image.program = map->program = resource->image.program;
	map->pou = g_strdup(pou);
	map->unit = find_unit(map->program, pou);
	map->watched = choose(map, map->unit, instance);
	find_owner(map, instance);
	map->instance = map->watched ? g_strdup(map->program->string + map->watched->name) : NULL;
	map->names = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
	take_names(map);
	return map;
}

void live_map_free(struct live_map *map)
{
	if (!map)
		return;
	g_hash_table_unref(map->names);
	g_free(map->instance);
	g_free(map->pou);
	g_free(map->owner);
	g_free(map);
}
