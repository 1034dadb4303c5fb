#!/usr/bin/perl
# Puts one fault after another into a copy of the tree and sees whether the tests named for it fail.
# The faults are in tests/mutants.txt. `make mutants` does all, `make mutants MUTANTS='hal canvas'` those whose
# path holds one of the words. A fault that no test finds ends the run with status 1.
use strict;
use warnings;
use File::Path qw(make_path);
use File::Basename qw(dirname);

my $BUILD = $ENV{BUILD} // 'build';
my $CC = $ENV{CC} // 'gcc';
my $COPY = "$BUILD/mutants";
my $SECONDS = 400; # a test that runs longer has found a fault: the program hangs

sub slurp { my ($path) = @_; open my $in, '<', $path or die "$path: $!\n"; local $/; return scalar <$in>; }
sub spew { my ($path, $text) = @_; open my $out, '>', $path or die "$path: $!\n"; print $out $text; close $out or die "$path: $!\n"; }

# A block is a path, lines `-` and `+` (what stands there, what stands there with the fault), and `?` for each test.
sub mutants {
	my @list;
	for my $block (split /\n\n+/, slurp('tests/mutants.txt')) {
		my %one = (from => [], to => [], tests => []);
		for my $line (split /\n/, $block) {
			next if $line =~ /^#/;
			if ($line =~ /^- (.*)/) { push @{$one{from}}, $1; }
			elsif ($line =~ /^\+ ?(.*)/) { push @{$one{to}}, $1; }
			elsif ($line =~ /^\? (.*)/) { push @{$one{tests}}, $1; }
			else { $one{path} = $line; }
		}
		push @list, \%one if $one{path};
	}
	return @list;
}

# A place is the one line, or run of lines, that says this whatever its indentation.
sub with_fault {
	my ($one) = @_;
	my $text = slurp($one->{path});
	my $from = join '\n', map { '[ \t]*' . quotemeta } @{$one->{from}};
	my $to = join "\n", map { "\t$_" } @{$one->{to}};
	my $count = () = $text =~ /^$from$/mg;
	die "$one->{path}: “$one->{from}[0]” stands there $count times, not once\n" if $count != 1;
	$text =~ s/^$from$/$to/m;
	return $text;
}

# What a test needs to be made: a program of its own, or the programs that people start and those whose path the script names.
sub needs {
	my ($test) = @_;
	my ($file) = split / /, $test;
	return $file if $file =~ m{^build/};
	my @named = map { glob "$COPY/build/$_*" } slurp($file) =~ m{(tests/(?:bin|hal|online)/[\w-]+)}g;
	my %named = map { s{^\Q$COPY/\E}{}r => 1 } grep { -f && -x && !m{\.[^/]*$} } @named;
	return join ' ', 'all', sort keys %named;
}

sub run_test {
	my ($test) = @_;
	my ($file, @words) = split / /, $test;
	my $first = $file =~ m{^build/} ? '' : (split /\n/, slurp($file))[0];
	my $command = $file =~ m{^build/} ? $test : $first =~ /python/ ? "/usr/bin/python3 $test" :
		$first =~ /perl/ ? "perl $test" : "sh $test";
	# A script that waits for windows may fail on a busy machine: it has found a fault if it fails twice.
	for my $again ($file =~ /\.py$/ ? (0, 1) : 0) {
		my $output = qx(cd $COPY && BUILD=build LADDER=build/ladder timeout $SECONDS $command 2>&1);
		return 0 if $? == 0 && $output =~ /^ok/m && $output !~ /^not ok/m;
	}
	return 1;
}

sub build { my ($what) = @_; return system("cd $COPY && make -s -j2 BUILD=build CC='$CC' $what >mutant.log 2>&1") == 0; }

my @wanted = @ARGV;
my @list = grep { my $one = $_; !@wanted || grep { index($one->{path}, $_) >= 0 } @wanted } mutants();
die "tests/mutants.txt: no fault in a file with that in its path: @wanted\n" unless @list;
my %text = map { $_ => with_fault($list[$_]) } 0 .. $#list; # all places are looked for before anything is built
# Files of an earlier run that are no longer in the tree would be tested, too.
system("mkdir -p $COPY && find $COPY -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} + && git ls-files -z --cached --others --exclude-standard | xargs -0 cp -p --parents -t $COPY") == 0 or die "cannot copy the tree\n";
build('all tests') or die "the copy in $COPY cannot be built: $COPY/mutant.log\n";
my (%sound, @survivors);
for my $i (0 .. $#list) {
	my $one = $list[$i];
	for my $test (@{$one->{tests}}) {
		next if exists $sound{$test};
		build(needs($test)) or die "$test cannot be built: $COPY/mutant.log\n";
		$sound{$test} = !run_test($test) or print "unsound $test: fails without a fault\n";
	}
	my $copy = "$COPY/$one->{path}";
	my $true = slurp($copy);
	spew($copy, $text{$i});
	my $by;
	for my $test (grep { $sound{$_} } @{$one->{tests}}) {
		$by = !build(needs($test)) ? 'the compiler' : run_test($test) ? $test : next;
		last;
	}
	spew($copy, $true);
	print $by ? 'found   ' : 'MISSED  ', "$one->{path}: $one->{to}[0]", $by ? "  ($by)\n" : "\n";
	$| = 1;
	push @survivors, $one unless $by;
}
printf "%d faults, %d found\n", scalar @list, @list - @survivors;
exit(@survivors ? 1 : 0);
