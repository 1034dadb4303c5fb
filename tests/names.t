#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# names.t - letters and spellings as Unicode has them: every code point, and random names, by
# the unicodedata of Python. It is skipped if that has another version of Unicode.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Limit ();

my $root = abs_path(dirname(__FILE__) . '/..');
my $build = $ENV{BUILD} // "$root/build";
my $folder = tempdir(CLEANUP => 1);
my ($version) = do { local (@ARGV, $/) = "$root/runtime/engine/base/letters.def"; <> } =~ /Database (\S+)\./;
my $python = -x '/usr/bin/python3' ? '/usr/bin/python3' : 'python3';
my $has = `$python -c 'import unicodedata; print(unicodedata.unidata_version)' 2>/dev/null`;
chomp $has;
plan skip_all => "Python has Unicode '$has', letters.def $version" if $has ne $version;

# Lines of names, and of the keys that they must have.
open my $program, '>', "$folder/keys.py" or die $!;
print $program <<'PYTHON';
import random, sys, unicodedata
def fold(c):
    whole = c.casefold()
    if len(whole) == 1:
        return whole
    lower = c.lower()
    return lower if len(lower) == 1 else c  # only the full folding is longer
def key(text):
    return ''.join(fold(c) for c in unicodedata.normalize('NFD', text))
random.seed(1)
codes = [c for c in range(0x20, 0x110000) if unicodedata.category(chr(c)) not in ('Cn', 'Cs', 'Cc')]
marks = [c for c in codes if unicodedata.combining(chr(c))]
special = [c for c in codes if unicodedata.decomposition(chr(c)) or fold(chr(c)) != chr(c)]
names = [chr(c) for c in codes]
names += [unicodedata.normalize('NFD', chr(c)) for c in special]
for _ in range(20000):
    name = ''
    for _ in range(random.randrange(1, 6)):
        name += chr(random.choice(random.choice((special, special, codes, range(0xac00, 0xd7a4)))))
        name += ''.join(chr(random.choice(marks)) for _ in range(random.randrange(4)))
    names.append(name)
with open(sys.argv[1], 'w', encoding='utf-8', newline='\n') as out:
    out.writelines(n + '\n' for n in names)
with open(sys.argv[2], 'w', encoding='utf-8', newline='\n') as out:
    out.writelines(key(n) + ' %d\n' % (len(n) == 1 and n > '\x7f' and ('a' + n).isidentifier()) for n in names)
PYTHON
close $program or die $!;
is(system($python, "$folder/keys.py", "$folder/names", "$folder/expected"), 0, 'names are made');
is(system("$build/unit/base/test_name --keys < $folder/names > $folder/got"), 0, 'keys are made');
open my $names, '<:raw', "$folder/names" or die $!;
open my $expected, '<:raw', "$folder/expected" or die $!;
open my $got, '<:raw', "$folder/got" or die $!;
my ($count, @odd) = (0);
while (my $name = <$names>) {
	my ($want, $have) = (scalar <$expected>, scalar <$got> // '');
	$count++;
	push @odd, map { chomp; $_ } "name $name", " expected $want", " got $have" if $want ne $have && @odd < 30;
}
is_deeply(\@odd, [], "$count names: the same keys as Python's");

# The table is what letters.pl makes, if perl has the same version.
SKIP: {
	my $own = `perl -MUnicode::UCD -e 'print Unicode::UCD::UnicodeVersion()'`;
	skip "perl has Unicode $own", 1 if $own ne $version;
	is(system("perl $root/runtime/engine/base/letters.pl | cmp -s - $root/runtime/engine/base/letters.def"), 0,
		'letters.def is what letters.pl writes');
}
done_testing();
