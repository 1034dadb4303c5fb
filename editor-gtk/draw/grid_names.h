/* SPDX-License-Identifier: MIT
 *
 * grid_names - the symbol, address and comment of an operand of a POU.
 *
 * An index of declared variables, for drawings. It does not resolve members and elements of
 * arrays: drawings show them as they are written. check/ knows their meaning.
 */
#ifndef EDITOR_GRID_NAMES_H
#define EDITOR_GRID_NAMES_H

#include "engine/model/project.h"

struct grid_name {
	const char *symbol;  /* "" for an address without a name                */
	const char *address; /* "%IX0.0"; "" if it has none                     */
	const char *type;    /* "BOOL", "TON"; "" if it is not declared          */
	const char *comment; /* of the declaration, with its delimiters; ""      */
	const char *init;    /* of an instance: "(P := 20)", as declared; ""    */
	bool local;          /* declared in the POU                             */
};

struct grid_names;
/**
 * grid_names_new - indexes the globals and the locals of a POU
 * @pou: of @project; NULL: only the globals
 *
 * Owns: the caller, grid_names_free(). @project must outlive it unchanged.
 */
struct grid_names *grid_names_new(const struct project *project, const struct pou *pou);
void grid_names_free(struct grid_names *names);
/** grid_names_find - an operand as it is written, in any case; an address finds the
 * variable AT it. Borrowed from the project and from @operand. */
struct grid_name grid_names_find(const struct grid_names *names, const char *operand);

#endif
