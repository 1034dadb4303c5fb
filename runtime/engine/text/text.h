/* SPDX-License-Identifier: MIT
 *
 * text - rung files to projects and back. docs/rung-file.md is the grammar.
 *
 * Reading judges form only: words, places, limits; check/ finds what a name means. Writing
 * gives the one canonical form.
 */
#ifndef TEXT_TEXT_H
#define TEXT_TEXT_H

#include "engine/base/diag.h"
#include "engine/base/sink.h"
#include "engine/model/project.h"
#include "engine/model/st.h"

/* Where INCLUDE gets its files from. */
struct text_source {
	/** Gives the text of @name as written behind INCLUDE in @from, malloc'ed,
	 * or NULL after a diagnostic. */
	char *(*load)(void *context, const char *from, const char *name,
		      size_t *len, struct diag_list *diags, struct diag place);
	void *context;
};

/* A file as it is on the disk. */
struct text_file {
	const char *name;  /* for diagnostics                                */
	const char *text;
	size_t len;
	bool foreign;      /* it was made from another tool's file           */
};

/**
 * text_read_files - reads files of plain IEC text as one project; one of them may be a rung file
 * @count: at least 1
 *
 * The rest is as of text_read(): names may be used before, and in another file than, their
 * declaration.
 */
bool text_read_files(struct project *project, const struct text_file *files, int count,
		     const struct text_source *source, struct diag_list *diags);

/**
 * text_read - reads a rung file, or plain IEC text, into an empty project
 * @source: NULL: INCLUDE is kept, but what it names is not read (ladder fmt)
 *
 * Goes on after an error to find the next. With an error the project must not be
 * used but for its names. Owns: @project.   Scan-safe: no.
 * Fails: false when it added an error.
 */
bool text_read(struct project *project, const char *file, const char *text,
	       size_t len, const struct text_source *source,
	       struct diag_list *diags);

/**
 * text_write - the canonical text of a project (parts of included files left out): plain IEC text
 * if it is one such file, else a rung file
 * Owns: the caller, free(); NUL-ended, @len without it.   Fails: NULL: no memory.
 */
char *text_write(const struct project *project, size_t *len);

/**
 * text_write_source - the canonical text of one file of the project, in the form that it has: a rung
 * file or plain IEC text
 * @number: of project.source
 *
 * Owns: the caller, free(). Scan-safe: no. Fails: NULL: no memory.
 */
char *text_write_source(const struct project *project, int number, size_t *len);

/**
 * text_outline - the canonical text as text_write gives it, and where its parts are
 * @take: is handed each part when it ends, so inner ones before outer ones; or NULL
 *
 * Owns: the caller, free().   Scan-safe: no.   Fails: NULL: no memory.
 */
char *text_outline(const struct project *project, size_t *len,
		   void (*take)(void *context, const struct text_span *span),
		   void *context);

/**
 * text_write_head, text_write_part, text_write_tail - the text of a rung file in pieces, one behind the
 * other: what stands above the parts, each part by its number, what stands below
 * @head: what text_write_head() returned, for the first part; 0: for the others. For the tail, if there
 *        is no part
 *
 * Scan-safe: no.
 */
uint32_t text_write_head(const struct project *project, const struct sink *sink);
void text_write_part(const struct project *project, int number, uint32_t head, const struct sink *sink);
void text_write_tail(const struct project *project, uint32_t head, const struct sink *sink);

/** text_write_pou_access - every VAR_ACCESS … END_VAR of @pou. Scan-safe: no. */
void text_write_pou_access(const struct project *project, const struct pou *pou, const struct sink *sink);
/** text_write_vars - every VAR … END_VAR of @table. Scan-safe: no. */
void text_write_vars(const struct project *project, const struct var_table *table,
		     const struct sink *sink);
/** text_write_sfc - a chart without its declarations. Scan-safe: no. */
void text_write_sfc(const struct project *project, const struct pou *pou,
		    const struct sink *sink);
/** text_write_st - Structured Text, a statement a line. Scan-safe: no. */
void text_write_st(const struct project *project, const struct st *st, const struct sink *sink);
/* Comments above a network or a rung: string ids; 0: none. */
struct text_heading {
	uint32_t label, title, comment;
	bool off;
};
/** text_write_heading - the comment, @word, NETWORK or RUNG, OFF, label and title, without a line's end.
 * Scan-safe: no. */
void text_write_heading(const struct project *project, const char *word, const struct text_heading *heading,
			const struct sink *sink);
/** text_write_network - a network of a body in FBD, its comments too. Scan-safe: no. */
void text_write_network(const struct project *project, const struct pou *pou, int number, const struct sink *sink);
/** text_statements - the string id of @count statements as text_write_st() writes them; 0: there are
 * none, or no memory. Scan-safe: no. */
uint32_t text_statements(struct project *project, struct st_item *item, int count);
/**
 * text_take_boxes - after rungs of @pou were replaced: the statements of its EXECUTE boxes from the
 * texts of their cells
 *
 * Lines are those of canonical text. Scan-safe: no. Fails: false: no memory, nothing changed.
 */
bool text_take_boxes(struct project *project, struct pou *pou);
/**
 * text_give_boxes - after statements were changed: the texts of the cells of EXECUTE boxes from them
 * @give: gets each text that is another, with its place; false ends it
 *
 * Scan-safe: no. Fails: false: @give did, or no memory.
 */
bool text_give_boxes(struct project *project, bool (*give)(void *context, uint32_t *slot, uint32_t text),
		     void *context);
/** text_write_il - an instruction list; it reads again to the same list, with new line numbers.
 * Scan-safe: no. */
void text_write_il(const struct project *project, const struct il *il,
		   const struct sink *sink);

/** text_is_plain - does @text begin as IEC text without the first line of a rung file: with PROGRAM,
 * FUNCTION, FUNCTION_BLOCK, TYPE, CONFIGURATION or VAR_GLOBAL, behind comments and pragmas? */
bool text_is_plain(const char *text, size_t len);

/* For the clipboard, undo and tests: one rung, and one cell. */
/** text_read_rung - from `RUNG …` rows; malloc'ed, the caller rung_free()s it. */
struct rung *text_read_rung(struct project *project, const char *text, size_t len,
			    struct diag_list *diags);
/**
 * text_read_var - one declaration, which becomes the last one of a block
 * @pou:   whose, not one that has a frame (its variables are pins and sizes); NULL: global
 * @block: of its table
 *
 * Takes back: vars_pop().   Fails: false; nothing but strings was added.
 */
bool text_read_var(struct project *project, struct pou *pou, int block,
		   const char *text, size_t len, struct diag_list *diags);
/** text_write_rung - canonical rows and head; malloc'ed, NULL: no memory. */
char *text_write_rung(const struct project *project, const struct rung *rung);
/** text_write_cell - `NO Open`, without comment; returns as snprintf. */
int text_write_cell(const struct project *project, const struct cell *cell,
		    char *out, size_t size);
#endif
