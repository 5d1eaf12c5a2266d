// Paths on a grid, for Unity and other C#: one map that can be edited, and a planner on it. The library is found
// as a native plugin (docs/c-in-game-engines.md says where its file goes). It needs C# 7.3 and no package.
//
// An object is for one thread at a time. For more threads give each a grid of its own, or a planner.
using System;
using System.Runtime.InteropServices;
using System.Text;

// Column and row: between centers of cells, or corners.
[StructLayout(LayoutKind.Sequential)]
public struct GridPoint
{
    public double X, Y;
    public GridPoint(double x, double y) { X = x; Y = y; }
}

[StructLayout(LayoutKind.Sequential)]
public struct GridArea
{
    public uint X, Y, Width, Height;
}

// A mistake, with the sentence of the library. The code is one of mediant.h, whose numbers stay.
public sealed class MediantException : Exception
{
    public readonly int Code;
    public MediantException(int code, string sentence) : base(sentence) { Code = code; }
}

public sealed class MediantGrid : IDisposable
{
    // The motion and the engine are texts of parameters, as "neighbors=8 corners=one" or "k=any gap=closed".
    // Blocked has a byte for each cell, row by row, 0 for free.
    public MediantGrid(int width, int height, byte[] blocked, string motion = null, string engine = null)
    {
        if (Native.mediant_interface() != Native.Interface)
            throw new MediantException(0, "libmediant has another interface than this file");
        if (blocked.LongLength != (long)width * height)
            throw new ArgumentException("a byte for each cell is needed", nameof(blocked));
        this.motion = motion;
        try
        {
            Check(Native.mediant_map_new((uint)width, (uint)height, blocked, out map));
            Check(Native.mediant_space_new(map, Text(motion), out space));
            Check(Native.mediant_index_prepare(space, Text(engine), IntPtr.Zero, out index));
            Check(Native.mediant_planner_new(index, out planner));
        }
        catch
        {
            Dispose();
            throw;
        }
    }

    // The shortest path's turns, with its ends; the number of points, 0 without a path. The array grows if it
    // must: keep it from frame to frame, and nothing is left to the garbage collector.
    public int Path(GridPoint start, GridPoint goal, ref GridPoint[] points, out double length)
    {
        Check(Native.mediant_planner_path(
            planner, start, goal, points, (UIntPtr)points.Length, out UIntPtr count, out length));
        return Fetch((int)count, ref points);
    }

    // As Path, but where no way leads to the goal it leads to the reachable place nearest to it; blocked ends
    // are moved to a free place. Further wishes: "max_expansions=1000", "timeout=2" (milliseconds).
    public int Find(GridPoint start, GridPoint goal, ref GridPoint[] points, string wishes = "nearest snap")
    {
        starts[0] = start;
        goals[0] = goal;
        Check(Native.mediant_planner_find(planner, starts, (UIntPtr)1, goals, (UIntPtr)1, Text(wishes),
            IntPtr.Zero, out Answer answer));
        int count = (int)answer.Points;
        if (points.Length < count) points = new GridPoint[count];
        Check(Native.mediant_planner_points(planner, points, (UIntPtr)points.Length, out UIntPtr _));
        return count;
    }

    // Blocks and frees the cells of a rectangle: a byte for each, row by row. It takes some hundredths of a
    // millisecond for a door, whatever the size of the map.
    public void Edit(GridArea area, byte[] blocked)
    {
        if (blocked.LongLength != (long)area.Width * area.Height)
            throw new ArgumentException("a byte for each cell of the area is needed", nameof(blocked));
        ulong newMap = 0, newSpace = 0, newIndex = 0;
        try
        {
            Check(Native.mediant_map_edit(map, area, blocked, out newMap));
            Check(Native.mediant_space_new(newMap, Text(motion), out newSpace));
            Check(Native.mediant_index_repair(index, newSpace, out newIndex));
            Check(Native.mediant_planner_follow(planner, newIndex));
            Swap(ref map, ref newMap);
            Swap(ref space, ref newSpace);
            Swap(ref index, ref newIndex);
        }
        finally
        {
            // The old ones, or after a mistake the new ones. Of a handle that is 0 nothing is freed.
            Native.mediant_index_free(newIndex);
            Native.mediant_space_free(newSpace);
            Native.mediant_map_free(newMap);
        }
    }

    public void Dispose()
    {
        GC.SuppressFinalize(this);
        // Nothing was made, perhaps since the library was not found.
        if (map == 0) return;
        Native.mediant_planner_free(planner);
        Native.mediant_index_free(index);
        Native.mediant_space_free(space);
        Native.mediant_map_free(map);
        map = space = index = planner = 0;
    }

    ~MediantGrid() { Dispose(); }

    // Handles are structures of one number in C, which are passed as the number.
    ulong map, space, index, planner;
    readonly string motion;
    readonly GridPoint[] starts = new GridPoint[1], goals = new GridPoint[1];

    int Fetch(int count, ref GridPoint[] points)
    {
        if (count > points.Length)
        {
            points = new GridPoint[count];
            Check(Native.mediant_planner_points(planner, points, (UIntPtr)count, out UIntPtr _));
        }
        return count;
    }

    static void Swap(ref ulong a, ref ulong b) { (a, b) = (b, a); }

    static void Check(int code)
    {
        if (code == 0) return;
        // The sentence is that of this thread: it is asked for before any other call.
        IntPtr sentence = Native.mediant_message();
        int size = 0;
        while (Marshal.ReadByte(sentence, size) != 0) size++;
        var bytes = new byte[size];
        Marshal.Copy(sentence, bytes, 0, size);
        throw new MediantException(code, Encoding.UTF8.GetString(bytes));
    }

    // A text of C: UTF-8, ended by 0; null is the library's choice.
    static byte[] Text(string text) => text == null ? null : Encoding.UTF8.GetBytes(text + "\0");

    [StructLayout(LayoutKind.Sequential)]
    struct Answer
    {
        public int Status, StoppedBy;
        public UIntPtr Points;
        public double Distance, Length, LowerBound, AnyAngleLowerBound;
    }

    // The functions of mediant.h that are used here. Arrays of numbers and points are pinned during a call, and
    // not copied.
    static class Native
    {
        // MEDIANT_INTERFACE of the header that these were written from.
        public const uint Interface = 1;
#if UNITY_IOS || UNITY_WEBGL
        const string Library = "__Internal";
#else
        const string Library = "mediant";
#endif
        [DllImport(Library)] public static extern uint mediant_interface();
        [DllImport(Library)] public static extern IntPtr mediant_message();
        [DllImport(Library)]
        public static extern int mediant_map_new(uint width, uint height, byte[] blocked, out ulong map);
        [DllImport(Library)]
        public static extern int mediant_map_edit(ulong map, GridArea area, byte[] blocked, out ulong edited);
        [DllImport(Library)]
        public static extern int mediant_space_new(ulong map, byte[] motion, out ulong space);
        [DllImport(Library)]
        public static extern int mediant_index_prepare(
            ulong space, byte[] engine, IntPtr watcher, out ulong index);
        [DllImport(Library)]
        public static extern int mediant_index_repair(ulong index, ulong space, out ulong repaired);
        [DllImport(Library)] public static extern int mediant_planner_new(ulong index, out ulong planner);
        [DllImport(Library)]
        public static extern int mediant_planner_path(
            ulong planner, GridPoint start, GridPoint goal, [Out] GridPoint[] points, UIntPtr room,
            out UIntPtr count, out double length);
        [DllImport(Library)]
        public static extern int mediant_planner_find(
            ulong planner, GridPoint[] starts, UIntPtr startCount, GridPoint[] goals, UIntPtr goalCount,
            byte[] wishes, IntPtr watcher, out Answer answer);
        [DllImport(Library)]
        public static extern int mediant_planner_points(
            ulong planner, [Out] GridPoint[] points, UIntPtr room, out UIntPtr count);
        [DllImport(Library)]
        public static extern int mediant_planner_follow(ulong planner, ulong index);
        [DllImport(Library)] public static extern int mediant_map_free(ulong map);
        [DllImport(Library)] public static extern int mediant_space_free(ulong space);
        [DllImport(Library)] public static extern int mediant_index_free(ulong index);
        [DllImport(Library)] public static extern int mediant_planner_free(ulong planner);
    }
}
