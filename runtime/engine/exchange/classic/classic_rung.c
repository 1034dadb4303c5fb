/* SPDX-License-Identifier: MIT
 *
 * classic_rung - the order of the text: declarations, sections in their order, functions.
 */
#include "engine/exchange/classic/classic_convert.h"
#include "engine/model/property.h"


#include <stdint.h>
#include <string.h>

/* ---- text ---- */

/* Removes the last line. */
static void unput(struct conversion *c)
{
	struct classic_text *out = c->out;

	if (out->len)
		out->len--;
	while (out->len && out->text[out->len - 1] != '\n')
		out->len--;
	if (out->text)
		out->text[out->len] = '\0';
	if (out->lines)
		out->lines--;
}

/* ---- the names of sections and rungs ---- */

/* A rung keeps its label; one that a jump leads to gets one. */
static void name_labels(struct conversion *c)
{
	const struct classic_project *project = c->project;

	for (int i = 0; i < project->rungs; i++) {
		const struct classic_rung *rung = project->rung[i];

		if (rung->label[0] || is_jumped_to(c, rung->number))
			c->label[i] = name_new(c, rung->label[0] ? rung->label :
					       text_of(c, "Rung%d", rung->number));
	}
}

static bool name_pous(struct conversion *c)
{
	const struct classic_project *project = c->project;

	c->pou = arena_alloc(c->arena, ((size_t)project->sections + 1) * sizeof(*c->pou));
	c->label = arena_alloc(c->arena, ((size_t)project->rungs + 1) * sizeof(*c->label));
	c->section_of = arena_alloc(c->arena, ((size_t)project->rungs + 1) *
				    sizeof(*c->section_of));
	if (!c->pou || !c->label || !c->section_of)
		return false;
	for (int i = 0; i < project->sections; i++) {
		const struct classic_section *section = &project->section[i];

		c->pou[i] = name_new(c, section->name[0] ? section->name :
				     text_of(c, "Section%d", section->number));
	}
	name_labels(c);
	return true;
}

/* ---- sections ---- */

static void mark_rungs(struct conversion *c, const struct classic_section *section)
{
	int index = classic_rung_index(c->project, section->first);

	while (index >= 0 && c->section_of[index] != c->section + 1) {
		const struct classic_rung *rung = c->project->rung[index];

		c->section_of[index] = c->section + 1;
		if (rung->number == section->last)
			return;
		index = classic_rung_index(c->project, rung->next);
	}
}

/* In the order of their chain, each at most once. */
static void write_rungs(struct conversion *c, const struct classic_section *section)
{
	const struct classic_rung *rung = classic_rung(c->project, section->first);

	mark_rungs(c, section);
	for (int i = 0; rung && i < c->project->rungs; i++) {
		c->at = rung->place;
		convert_rung(c, rung);
		if (rung->number == section->last || rung->next < 0)
			return;
		rung = classic_rung(c->project, rung->next);
	}
}

static void put_temporaries(struct conversion *c)
{
	for (int i = 0; i < c->temps.count; i++)
		put(c, "%s  %s : BOOL;\n", i ? "" : "VAR (* between the parts of a rung *)\n",
		    c->temps.name[i]);
	put(c, "%s", c->temps.count ? "END_VAR\n\n" : "");
}

static bool shown_before(const struct conversion *c, int index)
{
	const struct classic_section *section = c->project->section;

	for (int i = 0; i < index; i++)
		if (section[i].sequential && section[i].page == section[index].page)
			return true;
	return false;
}

static void write_section(struct conversion *c, int index)
{
	const struct classic_section *section = &c->project->section[index];
	bool called = section->subroutine >= 0;

	c->at = section->place;
	c->section = index;
	c->section_pou = c->pou[index];
	c->rungs_written = c->rung = 0;
	if (section->sequential && shown_before(c, index)) {
		tell(c, REPORT_CHANGED, "section \"%s\" shows page %d once more: a page runs "
		     "once a scan", section->name, section->page);
	} else if (section->sequential) {
		convert_sfc(c, section);
	} else {
		if (!called)
			add_program(c, c->pou[index]);
		put(c, "%s %s LD\n", called ? "SUBROUTINE" : "PROGRAM", c->pou[index]);
		write_rungs(c, section);
		c->at = section->place;
		put(c, "%s\n\n", called ? "END_SUBROUTINE" : "END_PROGRAM");
	}
	c->section_pou = NULL;
}

/* ---- head ---- */

/* In ClassicLadder a line break of a text is the two characters \n. */
static void put_lines(struct conversion *c, const char *text)
{
	put(c, "\"");
	for (; *text; text++) {
		if (text[0] == '\\' && text[1] == 'n') {
			put(c, "$N");
			text++;
		} else if ((unsigned char)*text < ' ') {
			put(c, " ");
		} else {
			put(c, "%s%c", *text == '"' || *text == '$' ? "$" : "", *text);
		}
	}
	put(c, "\"");
}

static void put_properties(struct conversion *c)
{
	for (int i = 0; i < PROPERTY_COUNT; i++) {
		const struct property_row *row = property_row(i);
		const char *text = row->key ? classic_setting(c->project, row->key) : NULL;

		if (!text || !*text)
			continue;
		put(c, "\n%s ", row->word);
		put_lines(c, text);
	}
}

static const char *title_of(struct conversion *c)
{
	const char *name = classic_setting(c->project, "PROJECT_NAME");
	const char *slash = strrchr(c->project->file, '/');

	return name && *name ? name : slash ? slash + 1 : c->project->file;
}

static bool has_array(const struct conversion *c, int type)
{
	return used_name(c, type, CLASSIC_ALL) != NULL;
}

/* Size that an area needs, in bytes; 0: its usual size is enough. A few bytes more than the
 * highest number in use: an index can lead there. */
static long beyond(struct conversion *c, const struct classic_memory_row *row, long usual)
{
	long numbers = has_array(c, row->type) ? words_of(c, row) : used_numbers(c, row);
	long most = (long)memory_numbers(row) * row->size / 8;
	long bytes = numbers * row->size / 8 + 16;

	bytes = bytes / 8 * 8;
	if (bytes > most)
		bytes = (most + 7) / 8 * 8;
	return bytes > usual ? bytes : 0;
}

static void write_areas(struct conversion *c)
{
	static const struct { int type; long usual; } row[] = {
		{ 0, 8192 }, { 50, 512 }, { 60, 512 }, { 65, 512 }, { 200, 8192 },
		{ 270, 256 }, { 280, 256 }, { 310, 512 }, { LINUXCNC_INPUT, 512 },
	};

	for (size_t i = 0; i < sizeof(row) / sizeof(*row); i++) {
		const struct classic_memory_row *memory = classic_memory_of(row[i].type);
		long bytes = beyond(c, memory, row[i].usual);

		if (bytes)
			put(c, "  AREA %s %ld;\n", memory->area, bytes);
	}
}

/* A CONFIGURATION with nothing in it is left out. */
static void write_configuration(struct conversion *c)
{
	size_t before;

	put(c, "CONFIGURATION %s\n", name_new(c, "Controller"));
	before = c->out->len;
	write_areas(c);
	if (c->options.task && c->programs.count) {
		const char *task = name_new(c, "Scan");

		put(c, "  TASK %s (INTERVAL := T#%dms);\n", task, c->project->period);
		for (int i = 0; i < c->programs.count; i++)
			put(c, "  PROGRAM %s WITH %s : %s;\n",
			    name_new(c, text_of(c, "%s_1", c->programs.name[i])), task,
			    c->programs.name[i]);
	}
	if (c->out->len > before)
		put(c, "END_CONFIGURATION\n\n");
	else
		unput(c);
}

static void write_head(struct conversion *c)
{
	put(c, "RUNGBOARD 1\nPROJECT ");
	put_quoted(c, title_of(c));
	put_properties(c);
	put(c, "\n\n");
}

/* ---- the report ---- */

static void tell_counts(struct conversion *c)
{
	const struct classic_project *project = c->project;
	static const char *const dialect[] = { "ClassicLadder",
		REPORTED("ClassicLadder of LinuxCNC"), REPORTED("a bare rung file") };
	struct { int count; const char *one, *many; } part[] = {
		{ project->rungs, REPORTED("rung"), REPORTED("rungs") },
		{ 0, REPORTED("program"), REPORTED("programs") },
		{ 0, REPORTED("subroutine"), REPORTED("subroutines") },
		{ project->steps, REPORTED("step"), REPORTED("steps") },
		{ project->transitions, REPORTED("transition"), REPORTED("transitions") },
		{ project->expressions, REPORTED("expression"), REPORTED("expressions") },
		{ 0, REPORTED("symbol"), REPORTED("symbols") },
	};
	const char *text = report_said(c->report, dialect[project->dialect]), *comma = ": ";

	for (int i = 0; i < project->sections; i++)
		part[project->section[i].subroutine < 0 ? 1 : 2].count++;
	for (int i = 0; i < project->symbols; i++)
		part[6].count += !symbol_is_none(&project->symbol[i]);
	for (size_t i = 0; i < sizeof(part) / sizeof(*part); i++) {
		if (!part[i].count)
			continue;
		text = text_of(c, "%s%s%d %s", text, comma, part[i].count,
			       report_said(c->report, part[i].count > 1 ? part[i].many :
							part[i].one));
		comma = ", ";
	}
	c->at = (struct classic_place){ "", 0 };
	tell(c, REPORT_TAKEN, "%s", text);
	tell(c, REPORT_TAKEN, "the scan's period, %d ms", project->period);
}

/* ms of a unit, by base. */
static int unit_of(const struct classic_block *block)
{
	static const int unit[] = { 60000, 1000, 100 };

	return unit[block ? block->base : 1];
}

/* A timer whose unit is the period has no remainder and never counts more than a unit. */
static bool timer_differs(const struct conversion *c, int number)
{
	return unit_of(classic_block(&c->project->iec_timer, number)) != c->project->period;
}

static bool monostable_differs(const struct conversion *c, int number)
{
	const struct classic_block *block = classic_block(&c->project->monostable, number);

	return block && block->preset * (int64_t)unit_of(block) % c->project->period;
}

static bool register_differs(const struct conversion *c, int number)
{
	return classic_block(&c->project->reg, number) != NULL;
}

/* Faults of ClassicLadder that the project could notice: of blocks that stand in rungs. */
static void tell_faults(struct conversion *c)
{
	static const struct {
		enum classic_kind kind;
		bool (*differs)(const struct conversion *c, int number);
		const char *text;
	} row[] = {
		{ CLASSIC_IEC_TIMER, timer_differs, REPORTED("timers (%TM): an interrupted time "
		  "does not shorten the next one, and a scan that is longer than a unit counts in "
		  "full") },
		{ CLASSIC_MONOSTABLE, monostable_differs, REPORTED("monostables (%M): one whose time "
		  "is no multiple of the period can be started again") },
		{ CLASSIC_REGISTER, register_differs, REPORTED("registers (%R): the place behind the "
		  "last one is not written to") },
	};

	if (c->options.faithful)
		tell(c, REPORT_TAKEN, "faults of ClassicLadder are repeated");
	for (size_t i = 0; i < sizeof(row) / sizeof(*row) && !c->options.faithful; i++)
		for (int number = 0; number < CLASSIC_LIMIT; number++)
			if (block_cells(c, row[i].kind, number) && row[i].differs(c, number)) {
				tell(c, REPORT_CHANGED, "%s", report_said(c->report, row[i].text));
				if (row[i].kind == CLASSIC_REGISTER && !c->project->register_list)
					tell(c, REPORT_CHANGED, "registers (%%R) have one place, "
					     "although SIZE_REGISTER_LIST is 0");
				break;
			}
}

static bool has_elements(const struct classic_rung *rung)
{
	for (int i = 0; i < CLASSIC_ROWS * CLASSIC_COLUMNS; i++)
		if (rung->cell[i / CLASSIC_COLUMNS][i % CLASSIC_COLUMNS].element)
			return true;
	return false;
}

static void report_rungs(struct conversion *c)
{
	for (int i = 0; i < c->project->rungs; i++) {
		c->at = c->project->rung[i]->place;
		if (!c->section_of[i] && has_elements(c->project->rung[i]))
			tell(c, REPORT_LOST, "no section has this rung");
	}
}

/* ---- all of it ---- */

static uint32_t taken_id(const struct conversion *c, const char *name)
{
	return name ? names_find_any(&c->taken, name, strlen(name)) : 0;
}

/* Finds the names and functions that the sections use: elements that are left out need no
 * declarations. */
static void find_written(struct conversion *c, const char *text)
{
	bool *word = arena_alloc(c->arena, (size_t)c->taken.count + 1);
	int temps = 0;
	size_t len;

	if (!word)
		return;
	for (; *text; text += len ? len : 1) {
		len = strcspn(text, " .,()[]|\n:;-+"); /* -RotateLeft(…) */
		if (len)
			word[names_find_any(&c->taken, text, len)] = true;
	}
	word[0] = false;
	for (int i = 0; i < c->names.count; i++)
		c->names.list[i].written = word[taken_id(c, c->names.list[i].name)];
	for (int i = 0; i < CLASSIC_FUNCTIONS; i++)
		if (!word[taken_id(c, c->function_name[i])])
			c->function_name[i] = NULL;
	for (int i = 0; i < c->temps.count; i++)
		if (word[taken_id(c, c->temps.name[i])])
			c->temps.name[temps++] = c->temps.name[i];
	c->temps.count = temps;
}

static void write_all(struct conversion *c)
{
	struct classic_text sections = { 0 }, *whole = c->out;

	/* Sections first: writing them tells which declarations and functions they need. */
	c->out = &sections;
	c->cap = 0;
	for (int i = 0; i < c->project->sections; i++)
		write_section(c, i);
	if (!c->out->len)
		put(c, "PROGRAM %s LD\nEND_PROGRAM\n\n", name_new(c, "Nothing"));
	find_written(c, c->out->text ? c->out->text : "");
	c->out = whole;
	c->cap = 0;
	c->at = (struct classic_place){ "", 0 };
	write_head(c);
	name_system(c);
	write_configuration(c);
	write_declarations(c);
	put_temporaries(c);
	write_system(c);
	for (int i = 0, from = 0; i < sections.lines; i++) {
		const char *end = memchr(sections.text + from, '\n',
					 sections.len - (size_t)from);

		c->at = sections.place[i];
		put(c, "%.*s\n", (int)(end - sections.text) - from, sections.text + from);
		from = (int)(end - sections.text) + 1;
	}
	c->at = (struct classic_place){ "", 0 };
	write_functions(c);
	write_kept(c);
}

bool classic_to_rung(const struct classic_project *project,
		     struct classic_options options, struct arena *arena,
		     struct classic_text *out, struct classic_report *report)
{
	struct conversion c = {
		.project = project, .options = options, .arena = arena, .out = out,
		.report = report, .at = { "", 0 },
	};
	bool good;

	memset(out, 0, sizeof(*out));
	if (!find_uses(&c))
		return false;
	find_names(&c);
	if (!name_pous(&c))
		return false;
	arena_init(&c.scratch);
	tell_counts(&c);
	tell_faults(&c);
	write_all(&c);
	report_rungs(&c);
	report_pages(&c);
	report_kept(&c);
	good = !arena->failed && !c.scratch.failed && !report->arena.failed && out->text;
	arena_free(&c.scratch);
	return good;
}
