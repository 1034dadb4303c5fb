/* SPDX-License-Identifier: MIT
 *
 * own_read - reads ClassicLadder projects for the second evaluator.
 *
 * Written from the description of the files, not from the importer, which it checks. It
 * expects good files: what it does not understand it ignores.
 */
#include "tests/classic/own_read.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

struct reading {
	struct arena *arena;
	struct classic_project *project;
	bool upstream, linuxcnc;
};

/* The line at *@at without its end and blanks around it; NULL: there is none. */
static char *take_line(struct reading *r, const char **at)
{
	const char *from = *at, *end = from + strcspn(from, "\n");
	char *line;

	if (!*from)
		return NULL;
	*at = *end ? end + 1 : end;
	from += strspn(from, " \t");
	while (end > from && strchr(" \t\r", end[-1]))
		end--;
	line = arena_copy(r->arena, from, (size_t)(end - from));
	return line ? line : (char *)"";
}

static const char *behind(const char *line, const char *key)
{
	size_t len = strlen(key);

	return strncmp(line, key, len) == 0 ? line + len : NULL;
}

/* Up to @most numbers with commas between them; the others are 0. */
static int numbers(const char *at, int *out, int most)
{
	int count = 0;

	memset(out, 0, (size_t)most * sizeof(*out));
	while (count < most) {
		char *end;

		out[count] = (int)strtol(at, &end, 10);
		if (end == at)
			break;
		count++;
		at = end + strspn(end, " \t");
		if (*at == ',')
			at++;
		else if (*at < '0' || *at > '9')
			break;
	}
	return count;
}

#define ADD(r, list, count) \
	arena_push((r)->arena, &(r)->project->list, &(r)->project->count, \
		   sizeof(*(r)->project->list))

/* ---- rungs ---- */

/* Numbers with one character between them, up to a comma or the end; how many. */
static int parts(const char *at, int *out, int most)
{
	int count = 0;

	for (char *end; count < most; at = end + strspn(end, " \t") + 1) {
		out[count] = (int)strtol(at, &end, 10);
		if (end == at)
			break;
		count++;
		if (!end[strspn(end, " \t")] || end[strspn(end, " \t")] == ',')
			break;
	}
	return count;
}

/* "200/19[200/4]" in @value; the index can be missing. */
static struct classic_variable variable(const int *value, int count)
{
	return (struct classic_variable){ value[0], value[1], count == 4 ? value[2] : -1,
					  count == 4 ? value[3] : 0 };
}

/* "3-0-0/19[200/4]"; a bare rung file has "3-0-0-19". */
static void cell(const char *text, struct classic_cell *out)
{
	int value[6] = { 0 }, count = parts(text, value, 6);

	out->element = value[0];
	out->top = value[1];
	out->variable = variable(value + 2, count - 2);
}

static void row(struct classic_rung *rung, const char *line)
{
	/* A bare rung file can have blanks alone between cells. */
	const char *between = strchr(line, ',') ? "," : " \t";
	char text[80];
	int x = 0;

	if (rung->rows == CLASSIC_ROWS)
		return;
	for (; line && x < CLASSIC_COLUMNS; line = strpbrk(line, between)) {
		line += strspn(line, " \t,");
		snprintf(text, sizeof(text), "%.*s", (int)strcspn(line, between), line);
		cell(text, &rung->cell[rung->rows][x++]);
	}
	rung->rows++;
	if (x > rung->columns)
		rung->columns = x;
}

static struct classic_rung *add_rung(struct reading *r, int number)
{
	struct classic_rung *rung = arena_alloc(r->arena, sizeof(*rung)), **slot;

	slot = ADD(r, rung, rungs);
	if (!rung || !slot)
		abort();
	*slot = rung;
	rung->number = number;
	rung->next = -1;
	for (int i = 0; i < CLASSIC_ROWS * CLASSIC_COLUMNS; i++)
		rung->cell[i / CLASSIC_COLUMNS][i % CLASSIC_COLUMNS].variable.index_type = -1;
	return rung;
}

static void rung_line(struct reading *r, struct classic_rung *rung, const char *line)
{
	const char *next = behind(line, "#NEXTRUNG=");

	r->upstream |= behind(line, "#VER=3") != NULL;
	if (next)
		rung->next = atoi(next);
	else if (*line && *line != '#' && *line != ';')
		row(rung, line);
}

/* ---- tables ---- */

static void block_line(struct reading *r, struct classic_blocks *blocks, const char *letters,
		       int values, const char *line, int *next)
{
	const char *at = behind(line, letters);
	struct classic_block *block;
	int value[3], number = *next;

	if (at)
		number = atoi(at);
	else if ((*line >= '0' && *line <= '9') || *line == '-')
		(*next)++;
	else
		return;
	numbers(at ? strchr(at, ',') + 1 : line, value, values);
	block = arena_push(r->arena, &blocks->block, &blocks->count, sizeof(*block));
	if (!block)
		abort();
	*block = (struct classic_block){ .number = number, .base = 1 };
	if (*letters == 'R')
		block->mode = value[0];
	else if (values == 1)
		block->preset = value[0];
	else
		block->base = value[0], block->preset = value[1];
	if (values == 3)
		block->mode = value[2];
}

static void expression_line(struct reading *r, const char *line, int *next, bool *numbered)
{
	struct classic_expression *expression;
	const char *text = line;
	int number = *next;

	*numbered |= behind(line, "#VER=") != NULL;
	if (*line == ';' || behind(line, "#VER="))
		return;
	if (*numbered) {
		number = atoi(line);
		text = strchr(line, ',');
		if (!text++)
			return;
	}
	(*next)++;
	if (!*text || strcmp(text, "#") == 0)
		return;
	expression = ADD(r, expression, expressions);
	if (expression)
		*expression = (struct classic_expression){ .number = number, .text = text };
}

static void section_line(struct reading *r, const char *line)
{
	struct classic_section *section;
	int value[6];

	if (*line < '0' || *line > '9')
		return;
	numbers(line, value, 6);
	section = ADD(r, section, sections);
	if (section)
		*section = (struct classic_section){ .number = value[0], .name = "",
			.sequential = value[1], .subroutine = value[2], .first = value[3],
			.last = value[4], .page = value[5] };
}

static int links(const int *value, int *link)
{
	int count = 0;

	while (count < CLASSIC_LINKS && value[count] >= 0) {
		link[count] = value[count];
		count++;
	}
	return count;
}

static void page_line(struct reading *r, const char *line)
{
	const char *comma = strchr(line, ',');
	struct classic_step *step;
	struct classic_transition *transition;
	int value[43], index = atoi(line + (*line != '\0'));

	if (!comma)
		return;
	numbers(comma + 1, value, 43);
	if (*line == 'S' && (step = ADD(r, step, steps))) {
		*step = (struct classic_step){ .index = index, .initial = value[0],
			.number = value[1], .page = value[2] };
	} else if (*line == 'T' && (transition = ADD(r, transition, transitions))) {
		*transition = (struct classic_transition){ .index = index, .page = value[40],
			.condition = { .type = -1, .index_type = -1 } };
		transition->activates = links(value, transition->activate);
		transition->deactivates = links(value + 10, transition->deactivate);
	}
}

/* "C0,0,200/19" */
static void condition_line(struct reading *r, const char *line)
{
	const char *at = *line == 'C' ? strchr(line, ',') : NULL;
	int value[4] = { 0 }, index = atoi(line + (*line != '\0')), count;

	at = at ? strchr(at + 1, ',') : NULL;
	if (!at)
		return;
	count = parts(at + 1, value, 4);
	for (int i = 0; i < r->project->transitions; i++)
		if (r->project->transition[i].index == index)
			r->project->transition[i].condition = variable(value, count);
}

static void setting_line(struct reading *r, char *line)
{
	char *equals = strchr(line, '=');
	struct classic_setting *setting;

	if (!equals || *line == ';' || !(setting = ADD(r, setting, settings)))
		return;
	*equals = '\0';
	*setting = (struct classic_setting){ .key = line, .value = equals + 1 };
	r->linuxcnc |= strcmp(line, "MODBUS_MAP_COIL_READ") == 0;
	if (strcmp(line, "PERIODIC_REFRESH") == 0)
		r->project->period = atoi(setting->value);
	if (strcmp(line, "SIZE_REGISTER_LIST") == 0)
		r->project->register_list = atoi(setting->value);
}

/* ---- members ---- */

static void member(struct reading *r, const char *name, const char *text)
{
	static const char *const only_upstream[] = { "project_infos.txt", "registers.csv",
		"config_events.csv", "modem_config.txt", "remote_alarms.txt", "spy_vars.csv" };
	static const struct { const char *name, *letters; int values; } tables[] = {
		{ "timers.csv", "T", 2 }, { "monostables.csv", "M", 2 }, { "counters.csv", "C", 1 },
		{ "timers_iec.csv", "TM", 3 }, { "registers.csv", "R", 1 },
	};
	struct classic_project *p = r->project;
	struct classic_blocks *blocks[] = { &p->timer, &p->monostable, &p->counter, &p->iec_timer,
					    &p->reg };
	struct classic_rung *rung = behind(name, "rung_") ? add_rung(r, atoi(name + 5)) : NULL;
	const char *at = text;
	bool numbered = false;
	int next = 0;
	char *line;

	for (size_t i = 0; i < sizeof(only_upstream) / sizeof(*only_upstream); i++)
		r->upstream |= strcmp(name, only_upstream[i]) == 0;
	while ((line = take_line(r, &at))) {
		if (rung)
			rung_line(r, rung, line);
		for (int i = 0; i < 5; i++)
			if (strcmp(name, tables[i].name) == 0)
				block_line(r, blocks[i], tables[i].letters, tables[i].values,
					   line, &next);
		if (strcmp(name, "arithmetic_expressions.csv") == 0)
			expression_line(r, line, &next, &numbered);
		else if (strcmp(name, "sections.csv") == 0)
			section_line(r, line);
		else if (strcmp(name, "sequential.csv") == 0)
			page_line(r, line);
		else if (strcmp(name, "general.txt") == 0 || strcmp(name, "com_params.txt") == 0)
			setting_line(r, line);
	}
	/* A condition can stand before its transition. */
	for (at = text; strcmp(name, "sequential.csv") == 0 && (line = take_line(r, &at));)
		condition_line(r, line);
}

static void container(struct reading *r, const char *text)
{
	char *line, *name = NULL;
	const char *from = NULL, *at = text, *begin = text;

	while ((line = take_line(r, &at))) {
		if (behind(line, "_FILE-")) {
			name = line + 6;
			from = at;
		} else if (behind(line, "_/FILE-") && name) {
			member(r, name, arena_copy(r->arena, from, (size_t)(begin - from)));
			name = NULL;
		}
		begin = at;
	}
}

/* Rungs below ";Rung:", old timers below ";Timers:". */
static void bare(struct reading *r, const char *text)
{
	struct classic_rung *rung = NULL;
	bool timers = false;
	int next = 0;
	char *line;

	r->project->dialect = CLASSIC_NUMERIC;
	while ((line = take_line(r, &text))) {
		if (*line == ';' && strstr(line, "Timers"))
			timers = true;
		else if (*line == ';' && (strstr(line, "Rung") || strstr(line, "rung")))
			rung = add_rung(r, r->project->rungs), timers = false;
		else if (timers)
			block_line(r, &r->project->timer, "T", 2, line, &next);
		else if (*line && !rung)
			rung = add_rung(r, r->project->rungs);
		if (rung && !timers)
			rung_line(r, rung, line);
	}
}

static char *whole(struct arena *arena, FILE *file)
{
	char *text = arena_alloc(arena, CLASSIC_BYTES + 1);
	size_t len = text && file ? fread(text, 1, CLASSIC_BYTES, file) : 0;

	if (text)
		text[len] = '\0';
	return text;
}

static void folder(struct reading *r, const char *path)
{
	DIR *dir = opendir(path);
	struct dirent *entry;
	char file_name[600];

	while (dir && (entry = readdir(dir))) {
		FILE *file;

		if (*entry->d_name == '.')
			continue;
		snprintf(file_name, sizeof(file_name), "%s/%s", path, entry->d_name);
		file = fopen(file_name, "rb");
		member(r, arena_copy(r->arena, entry->d_name, strlen(entry->d_name)),
		       whole(r->arena, file));
		if (file)
			fclose(file);
	}
	if (dir)
		closedir(dir);
}

static void file(struct reading *r, const char *path)
{
	FILE *plain = fopen(path, "rb"), *packed;
	char *text = whole(r->arena, plain), command[600];

	if (plain)
		fclose(plain);
	if (behind(text, "\x1f\x8b")) {
		snprintf(command, sizeof(command), "gzip -dc '%s'", path);
		packed = popen(command, "r");
		text = whole(r->arena, packed);
		if (packed)
			pclose(packed);
	}
	if (behind(text, "\xef\xbb\xbf"))
		text += 3;
	if (behind(text, "_FILES_CLASSICLADDER"))
		container(r, text);
	else
		bare(r, text);
}

/* ---- a whole project ---- */

static int by_rung(const void *a, const void *b)
{
	return (*(struct classic_rung *const *)a)->number -
	       (*(struct classic_rung *const *)b)->number;
}

static int by_section(const void *a, const void *b)
{
	return ((const struct classic_section *)a)->number -
	       ((const struct classic_section *)b)->number;
}

static int by_transition(const void *a, const void *b)
{
	return ((const struct classic_transition *)a)->index -
	       ((const struct classic_transition *)b)->index;
}

static int by_step(const void *a, const void *b)
{
	return ((const struct classic_step *)a)->index - ((const struct classic_step *)b)->index;
}

/* Without sections.csv all rungs, by number, are one section. */
static void one_section(struct reading *r)
{
	struct classic_project *p = r->project;

	for (int i = 0; i < p->rungs; i++)
		p->rung[i]->next = i + 1 < p->rungs ? p->rung[i + 1]->number : -1;
	section_line(r, "0,0,-1,0,0,0");
	p->section[0].first = p->rung[0]->number;
	p->section[0].last = p->rung[p->rungs - 1]->number;
}

struct classic_project *own_read(struct arena *arena, const char *path)
{
	struct reading r = { .arena = arena,
			     .project = arena_alloc(arena, sizeof(*r.project)) };
	struct classic_project *p = r.project;
	struct stat about;

	if (!p || stat(path, &about) != 0)
		return NULL;
	p->file = path;
	p->period = 50;
	p->register_list = 500;
	if (S_ISDIR(about.st_mode))
		folder(&r, path);
	else
		file(&r, path);
	if (p->dialect != CLASSIC_NUMERIC)
		p->dialect = r.linuxcnc && !r.upstream ? CLASSIC_LINUXCNC : CLASSIC_UPSTREAM;
	if (p->rungs)
		qsort(p->rung, (size_t)p->rungs, sizeof(*p->rung), by_rung);
	if (!p->sections && p->rungs)
		one_section(&r);
	if (p->sections)
		qsort(p->section, (size_t)p->sections, sizeof(*p->section), by_section);
	if (p->steps)
		qsort(p->step, (size_t)p->steps, sizeof(*p->step), by_step);
	if (p->transitions)
		qsort(p->transition, (size_t)p->transitions, sizeof(*p->transition),
		      by_transition);
	return p->sections ? p : NULL;
}

const char *own_expression(const struct classic_project *project, int number)
{
	for (int i = 0; i < project->expressions; i++)
		if (project->expression[i].number == number)
			return project->expression[i].text;
	return NULL;
}

const char *own_setting(const struct classic_project *project, const char *key)
{
	for (int i = 0; i < project->settings; i++)
		if (strcmp(project->setting[i].key, key) == 0)
			return project->setting[i].value;
	return NULL;
}
