/* SPDX-License-Identifier: MIT
 *
 * check_access - VAR_ACCESS: each name once, each path a variable of the type that is written.
 *
 * A desk may leave out the name of a program, so a name must not be that of another variable.
 */
#include "engine/check/access.h"

#include "engine/check/reserved.h"

#include "engine/model/located.h"

#include <stdio.h>
#include <string.h>

#define TYPE_MOST 80 /* bytes of a type in a message, at most                 */

/* ---- paths ---- */

static size_t head_len(const char *text)
{
	return strcspn(text, ".[");
}

static bool is_name(struct project *project, uint32_t name, const char *text, size_t len)
{
	struct names *names = &project->names;

	return name && names_fold(names, name) ==
		       names_fold(names, names_intern(names, text, len));
}

/* A program by its own name or that of its instance. */
static const struct pou *find_program(struct project *project, const char *text, size_t len,
				      bool *instance)
{
	const struct config *config = project->config;
	int pou = project_find_pou(project, text, len);

	*instance = false;
	if (pou >= 0)
		return project->pou[pou].kind == POU_PROGRAM ? &project->pou[pou] : NULL;
	for (int i = 0; config && i < config->count; i++) {
		const struct config_entry *entry = &config->entry[i];
		const char *name = project_text(project, entry->pou);

		if (entry->kind != CONFIG_PROGRAM || !is_name(project, entry->name, text, len))
			continue;
		pou = project_find_pou(project, name, strlen(name));
		*instance = true;
		return pou >= 0 && project->pou[pou].kind == POU_PROGRAM ?
		       &project->pou[pou] : NULL;
	}
	return NULL;
}

/* Has the program of a RESOURCE another name here, because an earlier RESOURCE has the name, too? */
static bool is_renamed(struct project *project, int from, int end, const char *text, size_t len)
{
	for (int i = from; i < end; i++)
		if (project->config->entry[i].own_name && is_name(project, project->config->entry[i].own_name, text, len))
			return true;
	return false;
}

struct access_path access_split(struct project *project, const struct access *access)
{
	const struct access_block *block = access_block_of(project, (int)(access - project->access));
	const char *text = project_text(project, access->path);
	struct access_path out = { 0 };
	size_t len = head_len(text);
	int from, end;

	if (block->pou) {
		out.pou = &project->pou[block->pou - 1];
		return out;
	}
	out.pou = text[len] == '.' ? find_program(project, text, len, &out.instance) : NULL;
	from = out.pou || text[len] != '.' ? -1 : located_resource(project, text, len, &end);
	if (from >= 0) {
		out.at = (uint32_t)len + 1;
		len = head_len(text + out.at);
		if (text[out.at + len] == '.' && !is_renamed(project, from, end, text + out.at, len))
			out.pou = find_program(project, text + out.at, len, &out.instance);
	}
	if (!out.pou)
		return out;
	out.program = out.at;
	out.program_len = (uint32_t)len;
	out.at += (uint32_t)len + 1;
	return out;
}

const struct meaning *access_find(struct scope *scope, const struct access *access,
				  enum diag_id *why)
{
	struct project *project = scope_project(scope);
	const struct access_path path = access_split(project, access);
	const char *text = project_text(project, access->path);
	const struct meaning *m;

	m = scope_find(scope, path.pou,
		       names_intern(&project->names, text + path.at, strlen(text + path.at)), why);
	if (m && (m->pou != path.pou || m->kind == MEANING_LITERAL)) {
		*why = DIAG_UNKNOWN_NAME; /* %IX0.3 or a global is no variable of Main */
		return NULL;
	}
	return m;
}

/* ---- messages ---- */

struct access_check {
	struct scope *scope;
	struct project *project;
	struct uses *uses;
	struct diag_list *diags;
	uint32_t *seen;      /* by folded name: line of VAR_ACCESS            */
	bool good;
};

static void report(struct access_check *c, enum diag_id id, const struct access *access,
		   const char *arg)
{
	const struct access_block *block =
		access_block_of(c->project, (int)(access - c->project->access));
	struct diag place = { .id = id, .file = block->file, .line = access->var.line };

	c->good &= diag_add(c->diags, place, "%s", arg);
}

static const char *text_of(const struct access_check *c, uint32_t id)
{
	return scope_text(c->scope, id);
}

/* ---- names ---- */

/* Whether @table has another variable of this name. */
static bool has_other(const struct var_table *table, const struct access *access,
		      const struct meaning *m)
{
	const int at = vars_find(table, access->var.fold);

	return at >= 0 && !(m && m->var == &table->var[at] && !m->offset);
}

static bool is_further(struct project *project, const char *name, size_t len)
{
	const struct config *config = project->config;

	for (int i = 0; config && i < config->count; i++)
		if (config->entry[i].kind == CONFIG_PROGRAM &&
		    is_name(project, config->entry[i].name, name, len) &&
		    project_is_further(project, &config->entry[i]))
			return true;
	return false;
}

/* Without a program in front, a name is that of the first instance's variable. */
static const struct meaning *own_name(const struct access_check *c, const struct access *access,
				      const struct meaning *m)
{
	const struct access_path path = access_split(c->project, access);
	const char *text = project_text(c->project, access->path);

	return path.instance && is_further(c->project, text + path.program, path.program_len) ?
		NULL : m;
}

static void check_name(struct access_check *c, const struct access *access,
		       const struct meaning *m)
{
	const char *name = text_of(c, access->var.name);
	const enum diag_id fault = reserved_fault(name);
	const struct meaning *own = own_name(c, access, m);
	char arg[4 * LIMIT_ARG];
	bool taken = project_find_pou(c->project, name, strlen(name)) >= 0 ||
		     is_further(c->project, name, strlen(name)) ||
		     has_other(&c->project->globals, access, m);

	if (fault != DIAG_COUNT && fault != DIAG_EXPECTED)
		report(c, fault, access, name);
	for (int i = 0; !taken && i < c->project->pou_count; i++)
		taken = c->project->pou[i].kind == POU_PROGRAM &&
			has_other(&c->project->pou[i].vars, access, own);
	if (taken && m) /* an unknown path is one mistake, not two */
		report(c, DIAG_ACCESS_TAKEN, access, name);
	if (c->seen[access->var.fold]) {
		const struct access *first = &c->project->access[c->seen[access->var.fold] - 1];

		snprintf(arg, sizeof(arg), "%.64s" DIAG_AND "%d", name, first->var.line);
		report(c, DIAG_DUPLICATE_NAME, access, arg);
	} else {
		c->seen[access->var.fold] = (uint32_t)(access - c->project->access) + 1;
	}
}

/* ---- paths and types ---- */

/* The program that has the first name of an unknown path; NULL: none. */
static const struct pou *hides_in(const struct access_check *c, const struct access *access)
{
	const char *text = text_of(c, access->path);
	struct names *names = &c->project->names;
	const uint32_t fold = names_fold(names, names_intern(names, text, head_len(text)));

	for (int i = 0; i < c->project->pou_count; i++)
		if (c->project->pou[i].kind == POU_PROGRAM &&
		    vars_find(&c->project->pou[i].vars, fold) >= 0)
			return &c->project->pou[i];
	return NULL;
}

static void report_unknown(struct access_check *c, const struct access *access,
			   enum diag_id why)
{
	const bool inside = access_split(c->project, access).pou;
	const struct pou *pou = why == DIAG_UNKNOWN_NAME && !inside ? hides_in(c, access) : NULL;
	const char *path = text_of(c, access->path);
	char arg[4 * LIMIT_ARG];

	if (!pou) {
		report(c, why, access, path);
		return;
	}
	snprintf(arg, sizeof(arg), "%.100s" DIAG_AND "%.60s", path, text_of(c, pou->name));
	report(c, DIAG_ACCESS_LOCAL, access, arg);
}

/* The type of @m as a declaration that means it, but for its array. */
static struct var like(const struct meaning *m)
{
	struct var var = { .type = m->type };

	if (m->kind == MEANING_ARRAY) {
		var.array = m->array;
		var.dims = m->dims;
		var.dim = (struct var_array *)(uintptr_t)m->dim;
	}
	if (m->type == IEC_NONE)
		var.fb = (enum word)m->word;
	if (m->type != IEC_STRING)
		return var;
	var.capacity = m->kind == MEANING_ARRAY && m->capacity ? m->capacity :
		       m->kind == MEANING_VARIABLE || m->kind == MEANING_ELEMENT ||
		       m->kind == MEANING_ARRAY ? m->var->capacity : 0;
	return var;
}

/* A text inside a structure has the capacity that its declaration gives it. */
static bool same_type(const struct var *a, const struct var *written)
{
	return a->type == written->type && a->fb == written->fb &&
	       a->array.count == written->array.count &&
	       (!a->array.count || (a->array.low == written->array.low &&
				    vars_same_bounds(a->dim, a->dims, written->dim, written->dims))) &&
	       (a->type != IEC_STRING || !a->capacity || a->capacity == written->capacity);
}

static void print_type(const struct access_check *c, const struct var *var, char *out, size_t size)
{
	struct sink_memory memory;

	sink_memory_init(&memory);
	{
		const struct sink sink = sink_to_memory(&memory);

		project_write_type(c->project, var, &sink);
	}
	snprintf(out, size, "%.*s", memory.failed ? 0 : (int)memory.len,
		 memory.text ? memory.text : "");
	sink_memory_free(&memory);
}

static void check_type(struct access_check *c, const struct access *access,
		       const struct meaning *m)
{
	struct var is = like(m);
	char type[TYPE_MOST], written[TYPE_MOST], arg[4 * LIMIT_ARG];

	if (m->kind == MEANING_ADDRESS && m->type != access->var.type &&
	    iec_type_row(m->type)->size == iec_type_row(access->var.type)->size &&
	    m->type != IEC_BOOL && !access->var.array.count && access->var.type != IEC_STRING)
		return; /* %MW4 has no type but its width */
	if (same_type(&is, &access->var))
		return;
	if (is.type == IEC_STRING && !is.capacity)
		is.capacity = IEC_STRING_DEFAULT;
	print_type(c, &is, type, sizeof(type));
	print_type(c, &access->var, written, sizeof(written));
	snprintf(arg, sizeof(arg), "%.60s" DIAG_AND "%.60s" DIAG_AND "%.60s",
		 text_of(c, access->path), type, written);
	report(c, DIAG_ACCESS_TYPE, access, arg);
}

/* An instance, or an array of them, has no value. */
static bool is_instance(const struct access_check *c, const struct meaning *m)
{
	return m->type == IEC_NONE && m->kind != MEANING_LITERAL &&
	       scope_row(c->scope, (enum word)m->word)->kind == WORD_FB;
}

/* The first index that is no number. */
static void report_index(struct access_check *c, const struct access *access)
{
	const char *at = text_of(c, access->path);
	char index[LIMIT_ARG];

	do {
		at += strcspn(at, "[") + 1;
		snprintf(index, sizeof(index), "%.*s", (int)strcspn(at, "]"), at);
	} while (strspn(index, "-+0123456789_") == strlen(index) && strchr(at, '['));
	report(c, DIAG_ACCESS_BOUND, access, index);
}

static void check_path(struct access_check *c, const struct access *access,
		       const struct meaning *m)
{
	const char *path = text_of(c, access->path);

	if (meaning_is_indexed(m)) {
		report_index(c, access);
		return;
	}
	if (is_instance(c, m)) {
		report(c, DIAG_ACCESS_INSTANCE, access, path);
		return;
	}
	check_type(c, access, m);
	if (access->writes && (!m->writable || m->constant))
		report(c, DIAG_ACCESS_WRITES, access, path);
	uses_add(c->uses, m, access->writes ? USE_READ | USE_WRITTEN : USE_READ);
}

bool check_access(struct scope *scope, struct uses *uses, struct arena *scratch,
		  struct diag_list *diags)
{
	struct access_check c = {
		.scope = scope, .project = scope_project(scope), .uses = uses,
		.diags = diags, .good = true,
	};
	enum diag_id why;

	if (!c.project->access_count)
		return true;
	c.seen = arena_alloc(scratch, ((size_t)c.project->names.count + 1) * sizeof(*c.seen));
	if (!c.seen)
		return false; /* the caller reports it */
	for (int i = 0; i < c.project->access_count; i++) {
		const struct access *access = &c.project->access[i];
		const struct meaning *m = access_find(scope, access, &why);

		check_name(&c, access, m);
		if (m)
			check_path(&c, access, m);
		else
			report_unknown(&c, access, why);
	}
	return c.good;
}
