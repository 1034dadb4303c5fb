/* SPDX-License-Identifier: MIT
 *
 * sim_panel_rows - the lines of the panel for a program: the variables that it declares and the
 * addresses that it uses without a name; of its plant, the variables not bound to the program.
 *
 * They are sorted by group, place of the I/O map, and address; rows without an address keep the
 * order of their declarations.
 */
#include "editor-gtk/live/sim_panel_row.h"

#include "editor-gtk/document/disk.h"
#include "editor-gtk/document/iomap_beside.h"
#include "editor-gtk/document/iomap_text.h"
#include "editor-gtk/kit/i18n.h"
#include "editor-gtk/sim/live_map.h"
#include "editor-gtk/kit/name_fold.h"

#include "engine/base/limits.h"
#include "engine/base/name.h"
#include "engine/model/args.h"
#include "engine/xref/xref.h"

#include <stdlib.h>
#include <string.h>

struct maker {
	LadderSim *sim;
	const struct twin *twin;
	const struct image *image;  /* of the program or its plant             */
	struct project *project;
	bool plant;
	GPtrArray *rows;
	GHashTable *comments;       /* of folded names                         */
	GHashTable *starts;         /* by place of ET: place of the timer's start */
	GHashTable *taken;          /* places that have a line                 */
	GHashTable *steps;          /* places of steps: they have lines of their chart */
	LadderSimRow *last;         /* instance whose pins follow               */
	gsize last_len;             /* length of its name                      */
	LadderSimRow *whole;        /* own block, array or structure whose parts follow */
	char *first;                /* the name that was asked last if it is a POU's */
	int pou;                    /* its POU; -1: it is none                 */
};

/* ---- comments ---- */

static char *plain_comment(const char *comment)
{
	const gsize len = strlen(comment);

	if (g_str_has_prefix(comment, "(*") && len >= 4)
		return g_strstrip(g_strndup(comment + 2, len - 4));
	return g_strstrip(g_strdup(g_str_has_prefix(comment, "//") ? comment + 2 : comment));
}

static void add_comment(struct maker *maker, const char *pou, const struct var *var)
{
	const char *name = project_text(maker->project, var->name);
	const char *comment = project_text(maker->project, var->comment);
	char *whole;

	if (!*comment)
		return;
	whole = g_strconcat(pou, *pou ? "." : "", name, NULL);
	g_hash_table_insert(maker->comments, name_fold(whole),
			    plain_comment(comment));
	g_free(whole);
	if (*pou)
		g_hash_table_insert(maker->comments, name_fold(name),
				    plain_comment(comment));
}

/* Locals first: without its POU, a name that is also a global means the global. */
static void find_comments(struct maker *maker)
{
	const struct project *project = maker->project;

	for (int p = 0; p < project->pou_count; p++)
		for (int i = 0; i < project->pou[p].vars.count; i++)
			add_comment(maker, project_text(project, project->pou[p].name),
				    &project->pou[p].vars.var[i]);
	for (int i = 0; i < project->globals.count; i++)
		add_comment(maker, "", &project->globals.var[i]);
}

/* Table[3] has the comment of Table, Main.Recipe.Speed that of Main.Recipe. */
static char *comment_of(struct maker *maker, const char *name)
{
	const char *found;
	char *key;

	if (g_hash_table_size(maker->comments) == 0)
		return NULL;
	key = name_fold(name);
	found = g_hash_table_lookup(maker->comments, key);
	for (gsize len = strlen(key); !found && len--;) {
		if (key[len] != '.' && key[len] != '[')
			continue;
		key[len] = '\0';
		found = g_hash_table_lookup(maker->comments, key);
	}
	g_free(key);
	return g_strdup(found);
}

/* ---- places ---- */

static gint64 place_key(struct location at)
{
	return (gint64)at.area << 40 | (gint64)(at.area ? 0 : at.type) << 34 | at.where;
}

static gpointer key_copy(gint64 key)
{
	return g_memdup2(&key, sizeof(key));
}

/* Where each timer keeps the time at which it began to run. */
static void find_starts(struct maker *maker)
{
	struct symbol_cursor cursor = { .whole = true };
	struct location at[2] = { { .type = IEC_NONE } }; /* ET, start        */
	struct symbol symbol;

	while (image_next_symbol(maker->image, &cursor, &symbol)) {
		const char *pin = symbol.block ? strrchr(symbol.name, '.') : NULL;

		if (!pin || strcmp(pin, ".IN") == 0)
			memset(at, 0, sizeof(at));
		else if (strcmp(pin, ".ET") == 0)
			at[0] = symbol.at;
		else if (strcmp(pin, ".start") == 0)
			at[1] = symbol.at;
		if (pin && at[0].type != IEC_NONE && at[1].type != IEC_NONE)
			g_hash_table_insert(maker->starts, key_copy(place_key(at[0])),
					    g_memdup2(&at[1], sizeof(at[1])));
	}
}

static struct iec_addr address_of(const struct maker *maker, struct location at)
{
	const struct areas *areas = &maker->image->program->areas;
	struct iec_addr addr = { .area = at.area };

	if (at.area != AREA_NONE) {
		addr.bits = 1;
		addr.byte = at.where / 8;
		addr.bit = at.where % 8;
		return addr;
	}
	addr.area = at.type == IEC_STRING ? AREA_NONE : areas_find(areas, at.where);
	if (addr.area != AREA_NONE) {
		addr.bits = (uint8_t)(8 * iec_type_row(at.type)->size);
		addr.byte = at.where - areas->at[addr.area];
	}
	return addr;
}

static bool comes_in(enum iec_area area)
{
	return area == AREA_I || area == AREA_AI || area == AREA_XI || area == AREA_XAI;
}

static bool goes_out(enum iec_area area)
{
	return area == AREA_Q || area == AREA_AQ || area == AREA_XQ || area == AREA_XAQ;
}

static bool is_driven(const struct maker *maker, struct iec_addr addr)
{
	const guint32 at = maker->image->program->areas.at[addr.area] + addr.byte;

	if (maker->plant || !maker->twin->plant.image.program || !comes_in(addr.area))
		return false;
	return addr.bits == 1 ? maker->twin->plant_drives[at] >> addr.bit & 1 :
				maker->twin->plant_drives[at] != 0;
}

/* ---- one line ---- */

static void place_bit(LadderSimRow *row, enum iec_area area)
{
	row->group = comes_in(area) ? SIM_INPUTS : goes_out(area) ? SIM_OUTPUTS : SIM_MEMORY;
	row->kind = goes_out(area) || area == AREA_SM || row->at.constant ? SIM_LAMP :
									   SIM_SWITCH;
}

static void place_value(LadderSimRow *row, enum iec_area area)
{
	const bool number = iec_type_row(row->at.type)->class & (ANY_NUM | CLASS_BITS);

	row->group = SIM_VALUES;
	row->kind = SIM_VALUE;
	if (!number || (!comes_in(area) && !goes_out(area)))
		return;
	row->group = SIM_ANALOGUE;
	row->kind = comes_in(area) ? SIM_SLIDER : SIM_LEVEL;
	sim_row_set_range(row, false, 0, 0);
}

static LadderSimRow *new_row(struct maker *maker, const char *name, gsize len,
			     struct location at)
{
	LadderSimRow *row = g_object_new(LADDER_TYPE_SIM_ROW, NULL);

	g_free(row->name);
	row->name = g_strndup(name, len);
	row->at = at;
	row->plant = maker->plant;
	row->named = live_named_find(maker->sim, maker->plant, "", row->name);
	row->comment = comment_of(maker, row->name);
	g_ptr_array_add(maker->rows, row);
	return row;
}

/* Adds a line as a part of @owner. */
static void become_part(LadderSimRow *row, LadderSimRow *owner)
{
	row->owner = g_strdup(owner->name);
	row->group = owner->group;
	if (!owner->parts)
		owner->parts = g_ptr_array_new_with_free_func(g_object_unref);
	g_ptr_array_add(owner->parts, g_object_ref(row));
}

/* @of: the line whose part it is; NULL: none. */
static void add_value(struct maker *maker, const char *name, struct location at,
		      LadderSimRow *of)
{
	const struct iec_addr addr = address_of(maker, at);
	char text[32];
	LadderSimRow *row;

	if (maker->plant && (comes_in(addr.area) || goes_out(addr.area)))
		return; /* bound to the program, which has a line for it */
	row = new_row(maker, name, strlen(name), at);
	if (at.type == IEC_BOOL)
		place_bit(row, addr.area);
	else
		place_value(row, addr.area);
	if (maker->plant)
		row->group = SIM_PLANT;
	if (of) {
		become_part(row, of);
		if (!row->comment) /* that of the variable in its block */
			row->comment = comment_of(maker, sim_row_label(row));
	}
	if (addr.area == AREA_NONE)
		return;
	iec_addr_print(addr, text, sizeof(text));
	if (!name_equal(text, name))
		row->address = g_strdup(text);
	row->driven = is_driven(maker, addr);
	g_hash_table_add(maker->taken, key_copy(place_key(at)));
}

/* ---- timers and counters ---- */

static bool is_name(const struct maker *maker, uint32_t id, const char *name, gsize len)
{
	return name_is(project_text(maker->project, id), name, len);
}

/* The argument at a pin where the instance is called; false: none. */
static bool find_arg(const struct maker *maker, int pou, const char *name,
		     const char *pin, struct arg *out)
{
	const struct pou *in = &maker->project->pou[pou];
	const gsize len = strlen(name);

	for (int r = 0; r < in->rung_count; r++) {
		const struct rung *rung = in->rung[r];

		for (int c = 0; c < rung->rows * rung->cols; c++)
			if (rung->cell[c].args && rung->cell[c].word != ELEM_EXECUTE &&
			    is_name(maker, rung->cell[c].operand, name, len) &&
			    args_find(project_text(maker->project, rung->cell[c].args), pin,
				      strlen(pin), out))
				return true;
	}
	return false;
}

/* Where the preset of an instance can be set: the variable at its pin, or the pin itself if
 * there is none. */
static struct location given_of(const struct maker *maker, const LadderSimRow *row,
				const char *pin)
{
	const struct location nowhere = { .type = IEC_NONE };
	const char *dot = strrchr(row->name, '.'), *own = dot ? dot + 1 : row->name;
	struct location at;
	struct arg arg;

	for (int p = 0; p < maker->project->pou_count; p++) {
		const char *pou = project_text(maker->project, maker->project->pou[p].name);
		char *name;

		if (dot && !name_is(pou, row->name, (gsize)(dot - row->name)))
			continue;
		if (!find_arg(maker, p, own, pin, &arg))
			continue;
		name = g_strdup_printf("%s.%.*s", pou, (int)arg.value_len, arg.value);
		at = image_find(maker->image, name, strlen(name));
		g_free(name);
		if (at.type == IEC_NONE)
			at = image_find(maker->image, arg.value, arg.value_len);
		return at.type == row->preset.type && !at.constant ? at : nowhere;
	}
	return row->preset;
}

static const struct word_row *word_of(const char *block)
{
	const enum word word = word_find(block, strlen(block));

	return word < WORD_COUNT ? word_row(word) : NULL;
}

static void end_block(struct maker *maker)
{
	LadderSimRow *row = maker->last;
	const struct word_row *word = row ? word_of(row->block) : NULL;
	const char *now, *goal;

	if (row && row->preset.type != IEC_NONE && live_word_counts(word, &now, &goal))
		row->given = given_of(maker, row, goal);
	maker->last = NULL;
}

static enum sim_group group_of(const struct word_row *word, bool counts)
{
	if (strcmp(explain_family(word), "Counters") == 0 || strstr(word->word, "COUNTER"))
		return SIM_COUNTERS;
	return counts || strcmp(explain_family(word), "Timers") == 0 ? SIM_TIMERS : SIM_BLOCKS;
}

static LadderSimRow *whole_new(struct maker *maker, const char *name, gsize len,
			       enum sim_group group, const char *type)
{
	LadderSimRow *row = new_row(maker, name, len, (struct location){ .type = IEC_NONE });

	row->group = maker->plant ? SIM_PLANT : group;
	row->kind = SIM_WHOLE;
	row->block = g_strdup(type);
	return row;
}

static void begin_block(struct maker *maker, const struct symbol *symbol, gsize len)
{
	const struct word_row *word = word_of(symbol->block);
	const char *now, *goal;
	const bool counts = word && live_word_counts(word, &now, &goal);
	LadderSimRow *row = whole_new(maker, symbol->name, len,
				      word ? group_of(word, counts) : SIM_BLOCKS,
				      symbol->block);

	if (counts)
		row->kind = SIM_PRESET;
	if (maker->whole)
		become_part(row, maker->whole);
	maker->last = row;
	maker->last_len = len;
}

static bool is_pin(const char *pin, const char *name)
{
	return name && name_equal(pin, name);
}

/* Where the line of the instance has its value, its preset, its lamp. */
static void take_pin(struct maker *maker, const struct symbol *symbol, const char *pin)
{
	LadderSimRow *row = maker->last;
	const gint64 key = place_key(symbol->at);
	const struct location *start;
	const char *now = NULL, *goal = NULL;

	live_word_counts(word_of(symbol->block), &now, &goal);
	if (is_pin(pin, goal)) {
		row->preset = symbol->at;
	} else if (is_pin(pin, now)) {
		row->at = symbol->at;
		start = g_hash_table_lookup(maker->starts, &key);
		if (start)
			row->start = *start;
	} else if (!symbol->is_input && symbol->at.type == IEC_BOOL &&
		   row->done.type == IEC_NONE) {
		row->done = symbol->at;
	} else if (!symbol->is_input && symbol->at.type != IEC_BOOL && !now &&
		   row->at.type == IEC_NONE) {
		row->at = symbol->at;
	}
}

static void add_pin(struct maker *maker, const struct symbol *symbol, const char *pin)
{
	LadderSimRow *part;

	take_pin(maker, symbol, pin);
	if (maker->last->owner) /* two levels are enough */
		return;
	add_value(maker, symbol->name, symbol->at, maker->last);
	part = maker->last->parts ? maker->last->parts->pdata[maker->last->parts->len - 1] : NULL;
	if (part && part->kind == SIM_SWITCH && !symbol->is_input)
		part->kind = SIM_LAMP;
}

/* ---- charts ---- */

static struct location find_in(const struct maker *maker, const char *pou, const char *step,
			       const char *what)
{
	char *name = g_strdup_printf("%s.%s.%s", pou, step, what);
	struct location at = image_find(maker->image, name, strlen(name));

	if (at.type == IEC_NONE)
		at = image_find(maker->image, name + strlen(pou) + 1,
				strlen(name) - strlen(pou) - 1);
	g_free(name);
	return at;
}

static void add_step(struct maker *maker, LadderSimRow *chart, const char *step)
{
	const struct location x = find_in(maker, chart->name, step, "X");
	const struct location t = find_in(maker, chart->name, step, "T");
	char *name = g_strdup_printf("%s.%s", chart->name, step);
	LadderSimRow *row;

	if (x.type != IEC_NONE) {
		row = new_row(maker, name, strlen(name), t);
		row->kind = SIM_STEP;
		row->done = x;
		become_part(row, chart);
		g_hash_table_add(maker->steps, key_copy(place_key(x)));
		g_hash_table_add(maker->steps, key_copy(place_key(t)));
	}
	g_free(name);
}

/* Charts of programs; one of a block has its steps among the parts of the instance. */
static void add_charts(struct maker *maker)
{
	for (int p = 0; p < maker->project->pou_count; p++) {
		const struct pou *pou = &maker->project->pou[p];
		const char *name = project_text(maker->project, pou->name);
		LadderSimRow *chart;

		if (!pou->sfc || pou->kind != POU_PROGRAM)
			continue;
		chart = whole_new(maker, name, strlen(name), SIM_CHARTS, NULL);
		for (int i = 0; i < pou->sfc->step_count; i++)
			add_step(maker, chart, project_text(maker->project,
							    pou->sfc->step[i].name));
	}
}

/* ---- all ---- */

/* Arrays of inputs and outputs have a line for each, as other inputs and outputs. */
static bool is_part(const struct maker *maker, const struct symbol *symbol, gsize head)
{
	const enum iec_area area = address_of(maker, symbol->at).area;

	return symbol->name[head] && !comes_in(area) && !goes_out(area);
}

static const struct var *var_in(const struct maker *maker, const struct var_table *vars,
				const char *name, gsize len)
{
	const int at = vars_find(vars, names_find_any(&maker->project->names, name, len));

	return at < 0 ? NULL : &vars->var[at];
}

/* -1: no POU has this name. Parts of one variable come one after another. */
static int find_pou(struct maker *maker, const char *name, gsize len)
{
	if (!maker->first || strncmp(maker->first, name, len) != 0 || maker->first[len]) {
		g_free(maker->first);
		maker->first = g_strndup(name, len);
		maker->pou = project_find_pou(maker->project, name, len);
	}
	return maker->pou;
}

/* The declaration of a name as in head_len(); NULL: of another table. A name without its POU is
 * that of a global, or of the only local with this name. */
static const struct var *declared(struct maker *maker, const char *name, gsize head)
{
	const struct project *project = maker->project;
	const char *dot = memchr(name, '.', head);
	const int pou = dot ? find_pou(maker, name, (gsize)(dot - name)) : -1;
	const struct var *var = NULL;

	if (pou >= 0)
		return var_in(maker, &project->pou[pou].vars, dot + 1,
			      head - (gsize)(dot + 1 - name));
	var = var_in(maker, &project->globals, name, head);
	for (int p = 0; !var && p < project->pou_count; p++)
		if (!pou_has_frame(&project->pou[p]))
			var = var_in(maker, &project->pou[p].vars, name, head);
	return var;
}

/* `Low.N1`, `Low.P1`: the wire of a network, whose name is not declared, and its value of the scan before. */
static bool is_wire(struct maker *maker, const char *name, gsize head)
{
	const char *tail = name + head;

	return tail[0] == '.' && (tail[1] == 'N' || tail[1] == 'P') && tail[2] &&
	       tail[2 + strspn(tail + 2, "0123456789")] == '\0' && !declared(maker, name, head);
}

/* Length of the declared name at the beginning of @name, with its POU if that is before it. */
static gsize head_len(struct maker *maker, const char *name)
{
	const gsize len = strcspn(name, ".[");
	const gsize head = name[len] == '.' && find_pou(maker, name, len) >= 0 ?
			   len + 1 + strcspn(name + len + 1, ".[") : len;

	return is_wire(maker, name, head) ? strlen(name) : head;
}

/* A structure is a variable, as an array of values is; an instance, and an array of them, are
 * blocks. */
static bool is_instance(struct maker *maker, const char *name, gsize head)
{
	const struct var *var = declared(maker, name, head);

	return var && var->type == IEC_NONE &&
	       words_row(&maker->project->words, var->fb)->kind != WORD_STRUCT;
}

/* The line of an own block, an array or a structure when its first part comes. */
static void begin_whole(struct maker *maker, const struct symbol *symbol, gsize head)
{
	if (maker->whole && strlen(maker->whole->name) == head &&
	    strncmp(maker->whole->name, symbol->name, head) == 0)
		return;
	maker->whole = whole_new(maker, symbol->name, head,
				 is_instance(maker, symbol->name, head) ? SIM_BLOCKS : SIM_VALUES,
				 NULL);
}

static void add_symbol(struct maker *maker, const struct symbol *symbol)
{
	const char *dot = symbol->block ? strrchr(symbol->name, '.') : NULL;
	const gsize len = dot ? (gsize)(dot - symbol->name) : 0;
	const gsize head = head_len(maker, symbol->name);
	const gint64 key = place_key(symbol->at);

	if (g_hash_table_contains(maker->steps, &key))
		return;
	if (is_part(maker, symbol, head) && (!dot || len > head))
		begin_whole(maker, symbol, head);
	else
		maker->whole = NULL;
	if (!dot) {
		end_block(maker);
		add_value(maker, symbol->name, symbol->at, maker->whole);
		return;
	}
	if (!maker->last || maker->last_len != len ||
	    strncmp(maker->last->name, symbol->name, len) != 0) {
		end_block(maker);
		begin_block(maker, symbol, len);
	}
	add_pin(maker, symbol, dot + 1);
}

static void add_symbols(struct maker *maker)
{
	struct symbol_cursor cursor = { 0 };
	struct symbol symbol;

	while (image_next_symbol(maker->image, &cursor, &symbol))
		if (!(symbol.flags & SYMBOL_HIDDEN))
			add_symbol(maker, &symbol);
	end_block(maker);
	maker->whole = NULL;
}

/* Does the program name an address that has no line yet? Its names are few beside its text. */
static bool has_addresses(const struct maker *maker)
{
	const struct names *names = &maker->project->names;
	struct iec_addr addr;

	for (int i = 0; i < names->count; i++) {
		const char *name = names_text(names, (uint32_t)i);
		struct location at;
		gint64 key;

		if (iec_addr_parse(name, strlen(name), &addr) != ADDR_OK)
			continue;
		at = image_locate(maker->image, addr);
		key = place_key(at);
		if (at.type != IEC_NONE && !g_hash_table_contains(maker->taken, &key))
			return true;
	}
	return false;
}

static void add_addresses(struct maker *maker)
{
	struct xref xref;
	char text[32];

	if (!has_addresses(maker))
		return;
	if (!xref_make(&xref, maker->project))
		g_error("out of memory");
	for (int i = 0; i < xref.count; i++) {
		const struct xref_use *use = &xref.use[i];
		const struct location at = use->target.what != XREF_ADDRESS ?
			(struct location){ .type = IEC_NONE } :
			image_locate(maker->image, use->target.addr);
		const gint64 key = place_key(at);

		if (at.type == IEC_NONE || g_hash_table_contains(maker->taken, &key))
			continue;
		iec_addr_print(use->target.addr, text, sizeof(text));
		add_value(maker, text, at, NULL);
	}
	xref_free(&xref);
}

static void add_program(struct maker *maker)
{
	if (!maker->image->program || !maker->project)
		return;
	maker->comments = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
	maker->starts = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, g_free);
	maker->taken = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL);
	maker->steps = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, NULL);
	find_comments(maker);
	find_starts(maker);
	add_charts(maker);
	add_symbols(maker);
	add_addresses(maker);
	g_hash_table_unref(maker->comments);
	g_hash_table_unref(maker->starts);
	g_hash_table_unref(maker->taken);
	g_hash_table_unref(maker->steps);
	g_clear_pointer(&maker->first, g_free);
}

/* ---- pins and places of the I/O map beside the project ---- */

/* The map is read as text, so that one with errors gives what can be understood of it. */
struct map {
	struct io_text io;
	GHashTable *rows;   /* key of an address -> row of `io`, + 1           */
	char *board;        /* "" if it says none                              */
	GPtrArray *places;  /* in the order of the map                         */
};

static gpointer address_key(struct iec_addr addr)
{
	return GUINT_TO_POINTER(((guint)addr.area << 24 | addr.byte) << 3 | addr.bit);
}

/* Of a bit of I or Q; nothing else has a pin. */
static bool read_address(const char *text, struct iec_addr *addr)
{
	return text && iec_addr_parse(text, strlen(text), addr) == ADDR_OK &&
	       addr->bits == 1 && (addr->area == AREA_I || addr->area == AREA_Q);
}

/* A line name is unique on the board, an offset only on its chip. Caller frees. */
static char *place_of(const struct map *map, int at)
{
	char *line = io_text_field(&map->io, at, IO_LINE);
	char *driver = io_text_field(&map->io, at, IO_DRIVER);
	const char *blank = line ? strrchr(line, ' ') : NULL;
	char *place = blank ? g_strndup(line, (gsize)(blank - line)) :
		      line && *line && *map->board ? g_strdup(map->board) :
						     g_strdup(driver ? driver : "");

	free(line);
	free(driver);
	return place;
}

static void read_row(struct map *map, int at)
{
	char *address = io_text_field(&map->io, at, IO_ADDRESS);
	char *place = place_of(map, at);
	struct iec_addr addr;

	if (read_address(address, &addr))
		g_hash_table_insert(map->rows, address_key(addr), GINT_TO_POINTER(at + 1));
	if (!g_ptr_array_find_with_equal_func(map->places, place, g_str_equal, NULL))
		g_ptr_array_add(map->places, g_steal_pointer(&place));
	free(address);
	g_free(place);
}

static bool read_map(struct map *map, const char *text, gsize len)
{
	char *board;

	if (!io_text_read(&map->io, text, len)) {
		io_text_free(&map->io);
		return false;
	}
	map->rows = g_hash_table_new(NULL, NULL);
	map->places = g_ptr_array_new_with_free_func(g_free);
	board = io_text_board(&map->io);
	map->board = g_strdup(board ? board : "");
	free(board);
	for (int i = 0; i < map->io.count; i++)
		read_row(map, i);
	return true;
}

static void clear_map(struct map *map)
{
	io_text_free(&map->io);
	g_hash_table_unref(map->rows);
	g_ptr_array_unref(map->places);
	g_free(map->board);
}

static void put_place(struct map *map, int at, LadderSimRow *row)
{
	char *line = io_text_field(&map->io, at, IO_LINE);
	char *comment = io_text_field(&map->io, at, IO_COMMENT);
	const char *blank = line ? strrchr(line, ' ') : NULL;
	guint number = 0;

	row->place = place_of(map, at);
	g_ptr_array_find_with_equal_func(map->places, row->place, g_str_equal, &number);
	row->place_number = (int)number;
	row->pin = line && *line ? g_strdup(blank ? blank + 1 : line) : NULL;
	row->pin_told = g_strdup_printf("%s  %s%s%s%s", row->place, row->pin ? row->pin : "",
					comment && *comment ? "  (" : "",
					comment && *comment ? comment : "",
					comment && *comment ? ")" : "");
	free(line);
	free(comment);
}

static void take_place(struct map *map, LadderSimRow *row)
{
	const char *address = row->address ? row->address : row->name;
	struct iec_addr addr;
	int at;

	if ((row->group != SIM_INPUTS && row->group != SIM_OUTPUTS) ||
	    !read_address(address, &addr))
		return;
	at = GPOINTER_TO_INT(g_hash_table_lookup(map->rows, address_key(addr)));
	if (at > 0) {
		put_place(map, at - 1, row);
		return;
	}
	row->place = g_strdup(_("not in the I/O map"));
	row->place_number = G_MAXINT;
}

static void take_map(const char *path, GPtrArray *rows)
{
	char *file = iomap_beside(path), *text = NULL;
	struct map map;
	gsize len;

	if (file)
		text = disk_read(file, LIMIT_TEXT, &len, NULL);
	if (text && read_map(&map, text, len)) {
		if (map.io.count > 0)
			for (guint i = 0; i < rows->len; i++)
				take_place(&map, rows->pdata[i]);
		clear_map(&map);
	}
	g_free(text);
	g_free(file);
}

/* ---- all of them, in order ---- */

/* NULL: it has no address and keeps the order of its declaration. */
static const char *order_key(const LadderSimRow *row)
{
	return row->owner ? NULL : row->address ? row->address :
	       row->name[0] == '%' ? row->name : NULL;
}

static int by_group(gconstpointer left, gconstpointer right)
{
	const LadderSimRow *a = *(LadderSimRow *const *)left;
	const LadderSimRow *b = *(LadderSimRow *const *)right;
	const char *x = order_key(a), *y = order_key(b);
	struct iec_addr at[2];

	if (a->group != b->group)
		return (int)a->group - (int)b->group;
	if (a->place_number != b->place_number)
		return a->place_number < b->place_number ? -1 : 1;
	if (!x || !y)
		return !x - !y;
	iec_addr_parse(x, strlen(x), &at[0]);
	iec_addr_parse(y, strlen(y), &at[1]);
	if (at[0].area != at[1].area)
		return (int)at[0].area - (int)at[1].area;
	if (at[0].byte != at[1].byte)
		return at[0].byte < at[1].byte ? -1 : 1;
	return (int)at[0].bit - (int)at[1].bit;
}

GPtrArray *sim_rows_new(LadderSim *sim)
{
	GPtrArray *rows = g_ptr_array_new_with_free_func(g_object_unref);
	const struct twin *twin = ladder_sim_twin(sim);
	struct maker maker = { .sim = sim, .twin = twin, .rows = rows };

	if (!twin)
		return rows;
	maker.image = &twin->resource.image;
	maker.project = ladder_project(ladder_sim_ladder(sim));
	add_program(&maker);
	if (ladder_sim_plant_ladder(sim)) {
		maker.plant = true;
		maker.image = &twin->plant.image;
		maker.project = ladder_project(ladder_sim_plant_ladder(sim));
		add_program(&maker);
	}
	take_map(ladder_document_path(ladder_sim_document(sim)), rows);
	/* g_ptr_array_sort() of GLib keeps the order of equals. */
	g_ptr_array_sort(rows, by_group);
	return rows;
}
