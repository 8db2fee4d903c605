// SPDX-License-Identifier: GPL-3.0-or-later
// The protocol's own client for Node, with its decoders, against orcaview. Started by foxglove_test.py in a folder that has them:
//   node foxglove_client.cjs ws://127.0.0.1:PORT/?token=TOKEN
// It prints one JSON object: what it has decoded, and what the server said.
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");
const WebSocket = require("ws");

const SECONDS = 4;
const seen = { server: {}, topics: {}, messages: {}, parameters: [], graph: {}, status: [], assets: [] };
const client = new FoxgloveClient({ ws: new WebSocket(process.argv[2], [FoxgloveClient.SUPPORTED_SUBPROTOCOL]) });
const readers = new Map();

// Numbers of 64 bits are none in JSON.
const plain = (message) => JSON.parse(JSON.stringify(message, (_, value) => {
  if (typeof value === "bigint") return Number(value);
  return ArrayBuffer.isView(value) ? Array.from(value, Number) : value;
}));

client.on("error", (error) => { seen.status.push(String(error)); });
client.on("serverInfo", (info) => { seen.server = info; });
client.on("status", (status) => { seen.status.push(status.message); });
client.on("parameterValues", ({ parameters }) => { seen.parameters.push(...parameters); });
client.on("connectionGraphUpdate", (graph) => { seen.graph = graph; });
client.on("fetchAssetResponse", ({ requestId, status, error, data }) => {
  seen.assets.push({ id: requestId, status, error, bytes: data?.byteLength, first: data && data.getUint32(0, true) });
});
client.on("advertise", (channels) => {
  if (!channels.some(({ topic }) => topic === "/robot_description")) return;  // which names the meshes
  for (const [id, uri] of ["package://pioneer/shell.stl", "package://pioneer/other.stl"].entries()) client.fetchAsset(uri, id);
});
client.on("advertise", (channels) => {
  for (const channel of channels) {
    seen.topics[channel.topic] = channel.schemaName;
    const subscription = client.subscribe(channel.id);
    readers.set(subscription, { topic: channel.topic, reader: new MessageReader(parse(channel.schema, { ros2: true })) });
  }
  client.subscribeConnectionGraph();
  client.getParameters(["planner.max_speed"], "1");
  client.setParameters([{ name: "planner.max_speed", value: 0.25 }], "2");
  const goal = client.advertise({ topic: "/goal_pose", encoding: "json", schemaName: "geometry_msgs/msg/PoseStamped" });
  const pose = { position: { x: 3, y: 6, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
  client.sendMessage(goal, Buffer.from(JSON.stringify({ header: {}, pose })));
});
client.on("message", ({ subscriptionId, timestamp, data }) => {
  const { topic, reader } = readers.get(subscriptionId);
  const entry = seen.messages[topic] ?? { count: 0 };
  entry.count += 1;
  entry.time = Number(timestamp) / 1e9;
  entry.last = plain(reader.readMessage(data));
  seen.messages[topic] = entry;
});
setTimeout(() => {
  process.stdout.write(JSON.stringify(seen), () => process.exit(0));
}, SECONDS * 1000);
