/* SPDX-License-Identifier: MIT
 *
 * limits - all bounds of the engine, in one place.
 *
 * All of them are checked when a program is loaded, so that the scan needs no check of
 * its own.
 */
#ifndef BASE_LIMITS_H
#define BASE_LIMITS_H

/* The most that an arena takes from the system at once: a small board has little
 * memory, a large one loses time to page faults. */
#ifdef RUNGBOARD_SMALL
#define LIMIT_CHUNK       8000
#else
#define LIMIT_CHUNK       ((2u << 20) - 64) /* a huge page with its header    */
#endif
#define LIMIT_COLS        64        /* columns of a rung                      */
#define LIMIT_ROWS        256       /* rows of a rung                         */
#define LIMIT_DIAGS       100       /* diagnostics kept; the rest are counted */
#define LIMIT_NAME        255       /* bytes of a name                        */
#define LIMIT_ARG         64        /* bytes of a part of a diagnostic         */
#define LIMIT_PARTS       160       /* bytes of all its parts                  */
#define LIMIT_TEXT        (64u << 20) /* bytes of one source file             */
#define LIMIT_INCLUDES    8         /* files that include one another         */
#define LIMIT_RUNGS       50000     /* rungs of one POU                       */
#define LIMIT_POUS        1024      /* POUs of one project                    */
#define LIMIT_VARS        200000    /* variables of one project               */
#define LIMIT_ELEMENTS    1000000   /* elements of one array                  */
#define LIMIT_INDICES     8         /* of one operand, found out in the scan  */
#define LIMIT_LOCATED     1000000   /* of all arrays with AT together         */
#define LIMIT_ELEMENT_WALK (16u << 20) /* of them, one by one, in an image   */
#define LIMIT_ARGS        20        /* parameters written at one box          */
#define LIMIT_BLOCKS      (512u << 20) /* bytes of all block copies of an image */
#define LIMIT_NESTING     16        /* structures and blocks in one another   */
#define LIMIT_CALLS       16        /* POUs that call one another             */
#define LIMIT_MEMBERS     60000     /* of one structure or block              */
#define LIMIT_OWN_WORDS   8192      /* functions, blocks, types of a project */
#define LIMIT_FN_INPUTS   16        /* inputs of an extensible function       */
#define LIMIT_FN_ARGS     17        /* of any: K of MUX and those it chooses from */
#define LIMIT_EXPR_DEPTH  64        /* nesting of an expression               */
#define LIMIT_EXPR_NODES  512       /* operands and operators of one          */
#define LIMIT_ST_LABELS   256       /* labels of a body of Structured Text */
#define LIMIT_ST_DEPTH    64        /* blocks of Structured Text in one another */
#define LIMIT_LOOPS       8         /* FOR inside FOR                         */
#define LIMIT_IL_DEPTH    64        /* open parentheses of an IL list         */
#define LIMIT_IMAGE       (64u << 20) /* bytes of a code image                */
#define LIMIT_DATA        (8u << 20)  /* bytes of a program's data            */
#define LIMIT_RETAIN      (16u << 20) /* bytes of one copy of retained values */
#define LIMIT_AREA        8192      /* bytes of I, Q and areas like them      */
#define LIMIT_MEMORY      (512u << 10) /* bytes of M, and of V                */
#define LIMIT_AREAS       (1u << 20)   /* bytes of all areas together         */
#define LIMIT_BUDGET      10000000  /* instructions of one scan               */
#define LIMIT_STEPS       4096      /* of a chart; it may have twice as many transitions */
#define LIMIT_ROUNDS      50        /* of a chart IN ORDER in one scan      */
#define LIMIT_STEP_USES   256       /* lines of a step                        */
#define LIMIT_BRANCHES    256       /* steps behind one FROM or TO            */
#define LIMIT_MACROS      8         /* macro-steps in one another             */
#define LIMIT_MARKINGS    20000     /* states of a chart that are examined    */
#define LIMIT_MARKINGS_BYTES (4u << 20) /* and the memory for them            */
#define LIMIT_TASKS       16        /* tasks of a configuration               */
#define LIMIT_LEVELS      4         /* tasks that are interrupted at the same time; each needs
				      * about 600 bytes of stack             */
#define LIMIT_TICK        100000    /* ns: shortest interval of a task        */
#define LIMIT_INTERVAL    86400000000000 /* ns: longest one, a day            */
#define LIMIT_FORCES      256       /* forced variables at one time           */
#define LIMIT_IO_POINTS   4096      /* lines of an I/O map                    */

#endif
